// SPDX-License-Identifier: Apache-2.0
#include "armature/base/alternatives.hpp"

#include <cstddef>

namespace armature::base {

std::string alternatives(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool last = i + 1 == names.size();
    list += (i == 0 ? "" : last ? " or " : ", ") + names[i];
  }
  return list;
}

}  // namespace armature::base
