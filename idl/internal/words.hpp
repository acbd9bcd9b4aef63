// SPDX-License-Identifier: Apache-2.0
#pragma once

// What back ends need to keep clear of the words of their languages.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

namespace armature::idl {

template <std::size_t N>
bool is_one_of(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// Another name, which no language keeps for itself either.
inline std::string changed(const std::string& name) {
  return name + (name.ends_with('_') ? "2" : "_");
}

}  // namespace armature::idl
