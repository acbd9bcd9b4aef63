// SPDX-License-Identifier: Apache-2.0
#pragma once

// From described values to Lua's and back: vectors and arrays are tables counted from 1, structs
// tables by the names of their fields.

#include <cstddef>
#include <limits>
#include <string>

#include <lua5.4/lua.hpp>

#include "armature/base/result.hpp"
#include "armature/types/type.hpp"

namespace armature::lua::internal {

void push_value(lua_State* lua, const types::Type& type, const void* value);

/// What stands at `index` as a value of `type`; the error begins with the path of the part at
/// fault, `[2].x must be a number, found nothing`.
base::Result<types::Value> value_at(lua_State* lua, int index, const types::Type& type);

/// For people: a number or text as it is, a table as `[1, 2]` or `{x: 1, y: 2}`; of longer lists
/// the first elements and how many there are.
std::string text_at(lua_State* lua, int index,
                    std::size_t most_elements = std::numeric_limits<std::size_t>::max());

}  // namespace armature::lua::internal
