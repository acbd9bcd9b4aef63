// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace armature::component {

/// `N m` of an argument that is called `torque [N m]`; empty if it has no unit.
constexpr std::string_view argument_unit(std::string_view argument) {
  const std::size_t open = argument.find(" [");
  if (open == std::string_view::npos || !argument.ends_with(']')) return {};
  return argument.substr(open + 2, argument.size() - open - 3);
}

}  // namespace armature::component
