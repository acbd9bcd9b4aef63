// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "armature/component/author.hpp"

namespace {

class Early final : public armature::component::Component {
 public:
  using Component::Component;
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(throwing, registry) {
  registry.add<Early>("Early", "comes before the exception");
  throw std::runtime_error("no licence");
}
