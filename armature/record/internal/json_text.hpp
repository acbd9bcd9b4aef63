// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/types/elements.hpp"

namespace armature::record::internal {

/// The member that holds a value which is no struct.
inline constexpr std::string_view kValueMember = "value";

inline constexpr std::string_view kInfinity = "1e999";

/// Appends `text` as a JSON string.
void append_json_string(std::string_view text, std::string& to);

inline bool is_float(const types::Type& type) {
  return type.kind == types::Kind::kFloat || type.kind == types::Kind::kDouble;
}

}  // namespace armature::record::internal
