// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
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

/// A number; none if there is none, or something else.
inline std::optional<double> number_in(const Json& object, const char* field) {
  const auto found = object.find(field);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

/// Whether it says where in a document something is, and that is not the whole document.
inline bool is_pointer(const std::string& text) {
  try {
    return !Json::json_pointer(text).empty();
  } catch (const Json::exception&) {
    return false;
  }
}

/// The number there; none if there is none, or something else.
inline std::optional<double> number_at(const Json& document, const std::string& place) {
  const Json::json_pointer pointer(place);
  if (!document.contains(pointer) || !document[pointer].is_number()) return std::nullopt;
  return document[pointer].get<double>();
}

}  // namespace armature::report
