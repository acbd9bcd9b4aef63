// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "armature/inspect/connections.hpp"
#include "armature/inspect/describe.hpp"

namespace armature::inspect::internal {

using Json = nlohmann::ordered_json;

/// Of `checked_as_json`: it changes when what is written means something else.
inline constexpr int kCheckedFormat = 1;

/// Properties, ports, operations, events, requirements and state machines, each as a list.
/// @param value_key  what a property's value is called
void add_members(const ComponentDescription& description, const char* value_key, Json& to);

/// Without its place in a file.
Json connection_json(const Connection& connection);

/// As text; what is not UTF-8, as texts of a library may be, is replaced, since JSON must be.
/// @param indent  -1: all on one line
inline std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace armature::inspect::internal
