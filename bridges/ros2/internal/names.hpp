// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/component/observing/observer.hpp"

namespace armature::ros2::internal {

/// What is wrong with the names of joints that a deployment gives: another number, a double or an
/// empty one.
std::vector<component::Observer::Objection> objections_to_names(
    const std::vector<std::string>& names, std::size_t joints);

/// For each of `wanted`, its place in `found`; the reason if a name is unknown, double or missing.
struct Places {
  std::vector<std::size_t> of;
  std::string refused;
};
Places places_of(const std::vector<std::string>& wanted, const std::vector<std::string>& found);

}  // namespace armature::ros2::internal
