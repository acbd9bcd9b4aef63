// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace armature::base {

/// `A, B, C`, as lists of names are in messages.
inline std::string joined(const std::vector<std::string>& texts, std::string_view between = ", ") {
  std::string result;
  for (const std::string& text : texts) {
    if (!result.empty()) result += between;
    result += text;
  }
  return result;
}

}  // namespace armature::base
