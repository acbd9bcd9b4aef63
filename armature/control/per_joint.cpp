// SPDX-License-Identifier: Apache-2.0
#include "armature/control/per_joint.hpp"

#include <string>

namespace armature::control {

base::Result<std::vector<double>> per_joint(std::string_view name,
                                            const std::vector<double>& numbers,
                                            std::size_t joints) {
  if (numbers.size() == joints) return numbers;
  if (numbers.size() == 1) return std::vector<double>(joints, numbers.front());
  return base::Error{std::string(name) + ": found " + std::to_string(numbers.size()) +
                     " numbers, expected " + std::to_string(joints) +
                     ", one for each joint, or one for all"};
}

}  // namespace armature::control
