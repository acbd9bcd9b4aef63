// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace armature::report {

/// Its keys stay in the order in which they were written.
using Json = nlohmann::ordered_json;

/// The text of a field; empty if there is none, or something else.
inline std::string text_in(const Json& object, const char* field) {
  if (!object.is_object() || !object.contains(field)) return {};
  const Json& value = object[field];
  return value.is_string() ? value.get<std::string>() : std::string();
}

}  // namespace armature::report
