// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/requirement.hpp"

#include <utility>

namespace armature::component {

Requirement::About::~About() = default;

Requirement::Requirement(Component& owner, std::unique_ptr<About> about) noexcept
    : owner_(owner), about_(std::move(about)) {}

Requirement::~Requirement() = default;

std::string Requirement::peer_name() const {
  return about_->peer == nullptr ? std::string() : about_->peer->get();
}

}  // namespace armature::component
