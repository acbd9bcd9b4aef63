// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/names.hpp"

#include <algorithm>

namespace armature::ros2::internal {

std::vector<component::Observer::Objection> objections_to_names(
    const std::vector<std::string>& names, std::size_t joints) {
  std::vector<component::Observer::Objection> found;
  if (names.size() != joints) {
    found.push_back({"joint_names has " + std::to_string(names.size()) +
                         " names, expected joints = " + std::to_string(joints),
                     "name each joint as the robot's description does"});
  }
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (name->empty() || std::find(names.begin(), name, *name) != name) {
      found.push_back({"joint_names has '" + *name + "' twice, or empty",
                       "name each joint as the robot's description does"});
    }
  }
  return found;
}

Places places_of(const std::vector<std::string>& wanted, const std::vector<std::string>& found) {
  Places places;
  for (const std::string& name : found) {
    if (std::ranges::count(found, name) > 1) return {{}, "joint '" + name + "' stands there twice"};
    if (std::ranges::find(wanted, name) == wanted.end()) {
      return {{}, "unknown joint '" + name + "'"};
    }
  }
  for (const std::string& name : wanted) {
    const auto at = std::ranges::find(found, name);
    if (at == found.end()) return {{}, "joint '" + name + "' is missing"};
    places.of.push_back(static_cast<std::size_t>(at - found.begin()));
  }
  return places;
}

}  // namespace armature::ros2::internal
