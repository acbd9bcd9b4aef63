// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <lua5.4/lua.hpp>

#include "armature/component/operations/command.hpp"
#include "armature/exec/application.hpp"

namespace armature::lua::internal {

/// How Lua reaches the application.
struct Access {
  exec::Application& application;
  exec::Caller caller;
  /// Told of each command that Lua begins, by its name; its handle is on top of the stack.
  std::function<void(lua_State*, const std::string& name)> begun{};
};

/// Makes every component a global by its name, with its properties, ports, operations and commands;
/// a part `left.d` of a composite is the field `d` of `left`. Names that are nobody's are errors.
/// @param access  lives as long as functions of `lua` are called
void install_components(lua_State* lua, const Access& access);

/// The command that a handle of the script is for; nullptr if there is none at `index`.
component::CommandHandle* command_at(lua_State* lua, int index);

/// Which command the handle at `index` is for: `Generator.moveTo`.
std::string command_name(lua_State* lua, int index);

/// Why a command ended that is not done.
std::string reason_of(const component::CommandHandle& command);

/// Ends the function that is called with an error at the line of the script that called it.
[[noreturn]] void refuse(lua_State* lua, const std::string& text);

}  // namespace armature::lua::internal
