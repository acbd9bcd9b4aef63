// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/components.hpp"

#include <cstdlib>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/inspect/acts.hpp"
#include "armature/inspect/items.hpp"
#include "armature/lua/internal/subscriptions.hpp"
#include "armature/lua/internal/table_reader.hpp"
#include "armature/lua/internal/values.hpp"

namespace armature::lua::internal {
namespace {

using component::CommandHandle;
using component::Component;
using inspect::Member;

constexpr const char* kComponent = "component";
constexpr const char* kCommand = "command";

const Access& access_of(lua_State* lua) {
  return *static_cast<const Access*>(lua_touserdata(lua, lua_upvalueindex(1)));
}

exec::Application& application_of(lua_State* lua) { return access_of(lua).application; }

Component& component_at(lua_State* lua, int index) {
  return **static_cast<Component**>(luaL_checkudata(lua, index, kComponent));
}

// --- calling operations and commands -------------------------------------------------------------

std::vector<types::Value> arguments_of(lua_State* lua, const Member& operation) {
  const auto given = static_cast<std::size_t>(lua_gettop(lua) - 1);
  if (const auto right = inspect::check_count(operation, given); !right) {
    refuse(lua, right.error());
  }
  const auto& wanted = operation.operation->signature().arguments;
  std::vector<types::Value> values;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    base::Result<types::Value> value = value_at(lua, static_cast<int>(i + 2), *wanted[i].type);
    if (!value) refuse(lua, inspect::argument_name(operation, i) + value.error());
    values.push_back(std::move(value).value());
  }
  return values;
}

void push_command(lua_State* lua, CommandHandle command, const std::string& name) {
  void* const place = lua_newuserdatauv(lua, sizeof(CommandHandle), 1);
  ::new (place) CommandHandle(std::move(command));
  luaL_setmetatable(lua, kCommand);
  lua_pushlstring(lua, name.data(), name.size());
  lua_setiuservalue(lua, -2, 1);
}

/// Upvalues: the access, the component, the name of the operation.
int call_operation(lua_State* lua) {
  const Access& access = access_of(lua);
  exec::Application& application = access.application;
  const auto& owner = **static_cast<Component**>(lua_touserdata(lua, lua_upvalueindex(2)));
  const std::string operation_name = lua_tostring(lua, lua_upvalueindex(3));
  const std::string name = owner.name() + "." + operation_name;
  if (lua_rawequal(lua, 1, lua_upvalueindex(2)) == 0) {
    refuse(lua, name + " is called with a colon: " + owner.name() + ":" + operation_name + "(...)");
  }
  const Member operation = *inspect::member_of(owner, operation_name);
  std::vector<types::Value> arguments = arguments_of(lua, operation);
  if (operation.operation->is_command()) {
    auto begun = inspect::begin(application, operation, std::move(arguments), access.caller);
    if (!begun) refuse(lua, begun.error());
    push_command(lua, std::move(begun).value(), name);
    if (access.begun) access.begun(lua, name);
    return 1;
  }
  const auto answer = inspect::call(application, operation, std::move(arguments), access.caller);
  if (!answer) refuse(lua, answer.error());
  if (!answer.value()) return 0;
  push_value(lua, answer.value()->type(), answer.value()->data());
  return 1;
}

// --- components ----------------------------------------------------------------------------------

int read_member(lua_State* lua) {
  const Component& component = component_at(lua, 1);
  const std::string name = text_at(lua, 2);
  const std::optional<Member> member = inspect::member_of(component, name);
  if (!member) {
    refuse(lua, "'" + component.name() + "' has no property, port, operation or event '" + name +
                    "'" + base::suggestion_in_brackets(name, inspect::member_names(component)));
  }
  if (member->has_value()) {
    const auto value = application_of(lua).value_of(component.name(), name);
    if (!value) refuse(lua, value.error());
    push_value(lua, value.value().type(), value.value().data());
    return 1;
  }
  if (member->event != nullptr) {
    push_event(lua, *member->event);
    return 1;
  }
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_pushvalue(lua, 1);
  lua_pushlstring(lua, name.data(), name.size());
  lua_pushcclosure(lua, call_operation, 3);
  return 1;
}

int write_member(lua_State* lua) {
  const Component& component = component_at(lua, 1);
  const std::string name = text_at(lua, 2);
  const std::optional<Member> member = inspect::member_of(component, name);
  const Access& access = access_of(lua);
  if (member) {
    const auto right = inspect::check_settable(access.application, *member, access.caller);
    if (!right) refuse(lua, right.error());
  }
  if (!member || (member->property == nullptr && member->input == nullptr)) {
    std::vector<std::string> known;
    for (const auto* one : component::interface_of(component).properties)
      known.emplace_back(one->name());
    refuse(lua, "'" + component.name() + "' has no property '" + name + "'" +
                    base::suggestion_in_brackets(name, known));
  }
  const bool inverts =
      member->property != nullptr && member->property->is_sign() && lua_isboolean(lua, 3);
  const auto value = value_at(lua, 3, inverts ? types::type_of<bool>() : member->type());
  if (!value) refuse(lua, component.name() + "." + name + value.error());
  const auto set = inspect::set(access.application, *member, value.value(), access.caller);
  if (!set) refuse(lua, set.error());
  return 0;
}

int name_component(lua_State* lua) {
  const std::string& name = component_at(lua, 1).name();
  lua_pushlstring(lua, name.data(), name.size());
  return 1;
}

// --- commands that were begun --------------------------------------------------------------------

CommandHandle& checked_command(lua_State* lua) {
  return *static_cast<CommandHandle*>(luaL_checkudata(lua, 1, kCommand));
}

int command_done(lua_State* lua) {
  lua_pushboolean(lua, checked_command(lua).ended());
  return 1;
}

int command_progress(lua_State* lua) {
  lua_pushnumber(lua, checked_command(lua).progress());
  return 1;
}

int command_reason(lua_State* lua) {
  const std::string reason = reason_of(checked_command(lua));
  lua_pushlstring(lua, reason.data(), reason.size());
  return 1;
}

int command_cancel(lua_State* lua) {
  checked_command(lua).cancel();
  return 0;
}

int command_text(lua_State* lua) {
  const std::string_view stage = component::name_of(checked_command(lua).stage());
  lua_pushfstring(lua, "%s (%s)", command_name(lua, 1).c_str(), std::string(stage).c_str());
  return 1;
}

int forget_command(lua_State* lua) {
  checked_command(lua).~CommandHandle();
  return 0;
}

void make_command_type(lua_State* lua) {
  constexpr luaL_Reg kMethods[] = {{"done", command_done},
                                   {"progress", command_progress},
                                   {"reason", command_reason},
                                   {"cancel", command_cancel},
                                   {nullptr, nullptr}};
  luaL_newmetatable(lua, kCommand);
  luaL_newlib(lua, kMethods);
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, command_text);
  lua_setfield(lua, -2, "__tostring");
  lua_pushcfunction(lua, forget_command);
  lua_setfield(lua, -2, "__gc");
  lua_pushliteral(lua, "command");
  lua_setfield(lua, -2, "__metatable");
  lua_pop(lua, 1);
}

void make_component_type(lua_State* lua, const Access& access) {
  const auto add = [&](const char* name, lua_CFunction function) {
    lua_pushlightuserdata(lua, const_cast<Access*>(&access));
    lua_pushcclosure(lua, function, 1);
    lua_setfield(lua, -2, name);
  };
  luaL_newmetatable(lua, kComponent);
  add("__index", read_member);
  add("__newindex", write_member);
  add("__tostring", name_component);
  lua_pushliteral(lua, "component");
  lua_setfield(lua, -2, "__metatable");
  lua_pop(lua, 1);
}

// --- names ---------------------------------------------------------------------------------------

std::vector<std::string> keys_of(lua_State* lua, int table) {
  std::vector<std::string> keys;
  for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1)) {
    if (lua_type(lua, -2) == LUA_TSTRING) keys.emplace_back(lua_tostring(lua, -2));
  }
  return keys;
}

/// Upvalue: the components, of the application or of a composite, by their names in it.
int read_unknown(lua_State* lua) {
  lua_settop(lua, 2);
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, lua_upvalueindex(1)) != LUA_TNIL) return 1;
  const std::string name = text_at(lua, 2);
  lua_pushvalue(lua, lua_upvalueindex(1));
  std::vector<std::string> known = keys_of(lua, lua_gettop(lua));
  lua_pop(lua, 1);
  if (base::near_name(name, known).empty()) {
    for (std::string& key : keys_of(lua, 1)) known.push_back(std::move(key));
  }
  refuse(lua, "unknown component or variable '" + name + "'" +
                  base::suggestion_in_brackets(name, known));
}

int write_unknown(lua_State* lua) {
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, lua_upvalueindex(1)) != LUA_TNIL) {
    refuse(lua, "'" + text_at(lua, 2) + "' is a component: give your variable another name");
  }
  lua_settop(lua, 3);
  lua_rawset(lua, 1);
  return 0;
}

int refuse_write(lua_State* lua) {
  refuse(lua, "a composite has no variables: '" + text_at(lua, 2) + "'");
}

/// The table on top answers what it does not have from the table at `components`.
void answer_from(lua_State* lua, int components, lua_CFunction write) {
  lua_createtable(lua, 0, 3);
  lua_pushvalue(lua, components);
  lua_pushcclosure(lua, read_unknown, 1);
  lua_setfield(lua, -2, "__index");
  lua_pushvalue(lua, components);
  lua_pushcclosure(lua, write, 1);
  lua_setfield(lua, -2, "__newindex");
  lua_pushboolean(lua, 0);
  lua_setfield(lua, -2, "__metatable");
  lua_setmetatable(lua, -2);
}

/// Replaces the table of names on top by that of the parts of `name`, which is made if need be.
void enter_composite(lua_State* lua, const std::string& name) {
  const int names = lua_gettop(lua);
  lua_pushlstring(lua, name.data(), name.size());
  if (lua_rawget(lua, names) != LUA_TTABLE) {
    lua_pop(lua, 1);
    lua_createtable(lua, 0, 0);  // what the script sees: always empty, so that it asks
    lua_createtable(lua, 0, 0);  // the parts
    lua_pushvalue(lua, -2);
    answer_from(lua, names + 2, refuse_write);
    lua_pop(lua, 1);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, lua_topointer(lua, -2));
    lua_pushlstring(lua, name.data(), name.size());
    lua_pushvalue(lua, -2);
    lua_rawset(lua, names);
  }
  lua_rawgetp(lua, LUA_REGISTRYINDEX, lua_topointer(lua, -1));
  lua_replace(lua, names);
  lua_settop(lua, names);
}

void add_component(lua_State* lua, int names, Component& component) {
  auto** const place = static_cast<Component**>(lua_newuserdatauv(lua, sizeof(Component*), 0));
  *place = &component;
  luaL_setmetatable(lua, kComponent);
  const int object = lua_gettop(lua);
  lua_pushvalue(lua, names);
  std::string_view rest = component.name();
  for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    enter_composite(lua, std::string(rest.substr(0, dot)));
    rest.remove_prefix(dot + 1);
  }
  lua_pushlstring(lua, rest.data(), rest.size());
  lua_pushvalue(lua, object);
  lua_rawset(lua, -3);
  lua_settop(lua, object - 1);
}

}  // namespace

void refuse(lua_State* lua, const std::string& text) {
  luaL_where(lua, 1);
  lua_pushlstring(lua, text.data(), text.size());
  lua_concat(lua, 2);
  lua_error(lua);
  std::abort();  // lua_error does not return, but does not say so
}

CommandHandle* command_at(lua_State* lua, int index) {
  return static_cast<CommandHandle*>(luaL_testudata(lua, index, kCommand));
}

std::string command_name(lua_State* lua, int index) {
  lua_getiuservalue(lua, index, 1);
  std::string name = text_at(lua, -1);
  lua_pop(lua, 1);
  return name;
}

std::string reason_of(const CommandHandle& command) {
  const bool failed = command.ended() && command.stage() != component::CommandStage::kDone;
  if (!failed) return {};
  const std::string_view reason = command.reason();
  return std::string(reason.empty() ? component::name_of(command.stage()) : reason);
}

void install_components(lua_State* lua, const Access& access) {
  make_component_type(lua, access);
  make_command_type(lua);
  lua_createtable(lua, 0, 0);
  const int names = lua_gettop(lua);
  for (const exec::ComponentEntry& entry : access.application.blueprint().components) {
    add_component(lua, names, *entry.component);
  }
  lua_pushglobaltable(lua);
  answer_from(lua, names, write_unknown);
  lua_settop(lua, names - 1);
}

}  // namespace armature::lua::internal
