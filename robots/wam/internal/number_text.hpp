// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>

#include "armature/component/outcome.hpp"

namespace armature::wam::internal {

/// Three digits of a number, without allocation.
inline component::Reason& append_number(component::Reason& text, double number) {
  std::array<char, 32> room{};
  const auto end = std::to_chars(room.begin(), room.end(), number, std::chars_format::general, 3);
  const auto size = static_cast<std::size_t>(end.ptr - room.data());
  return text.append({room.data(), std::min(size, room.size())});
}

}  // namespace armature::wam::internal
