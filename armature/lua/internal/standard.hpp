// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <lua5.4/lua.hpp>

#include "armature/lua/internal/sources.hpp"

namespace armature::lua::internal {

/// What of Lua's own libraries scripts have: what neither leaves the sandbox nor differs from run
/// to run. Also `print`, `array` and `require`.
/// @param print, sources  live as long as `lua`
void install_standard(lua_State* lua, const std::function<void(std::string_view)>& print,
                      Sources& sources);

}  // namespace armature::lua::internal
