// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace armature::base {

/// True if `pattern`, in which a `*` is any number of characters but dots, is `name`.
inline bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() != '*') {
    return !name.empty() && name.front() == pattern.front() &&
           matches(pattern.substr(1), name.substr(1));
  }
  const std::string_view rest = pattern.substr(1);
  for (std::size_t length = 0; length <= name.size(); ++length) {
    if (matches(rest, name.substr(length))) return true;
    if (length < name.size() && name[length] == '.') return false;
  }
  return false;
}

}  // namespace armature::base
