// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/types/type.hpp"

namespace armature::record::internal {

/// A type as types::layout_text tells it, where the type itself is not known.
struct Layout {
  types::Kind kind = types::Kind::kBool;
  std::string field{};                           ///< its name in the struct around it
  std::size_t count = 0;                         ///< of an array
  std::vector<Layout> parts{};                   ///< of a struct, or the element of a list
  types::Kind underlying = types::Kind::kInt32;  ///< of an enumeration
  std::vector<types::Enumerator> enumerators{};  ///< likewise
};

/// Nothing if it is no layout.
std::optional<Layout> parse_layout(std::string_view text);

}  // namespace armature::record::internal
