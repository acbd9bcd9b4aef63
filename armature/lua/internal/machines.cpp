// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/machines.hpp"

#include <algorithm>
#include <string_view>

#include "armature/base/near_name.hpp"
#include "armature/lua/internal/components.hpp"
#include "armature/lua/internal/schedule.hpp"
#include "armature/lua/internal/table_reader.hpp"
#include "armature/lua/internal/values.hpp"

namespace armature::lua::internal {
namespace {

constexpr const char* kMachine = "machine";
constexpr std::size_t kMostMachines = 100;

/// What Lua has of a machine.
struct Handle {
  Machines* machines;
  Machine* machine;
};

Handle& checked(lua_State* lua) { return *static_cast<Handle*>(luaL_checkudata(lua, 1, kMachine)); }

std::string named(const Machine& machine) { return "machine '" + machine.name() + "'"; }

/// A mistake in an action is one of whoever caused it; `stop()` ends that one as well.
int end_of_turn(lua_State* lua, Machines& machines, int results) {
  if (const auto mistake = machines.take_mistake()) {
    lua_pushlstring(lua, mistake->data(), mistake->size());
    return lua_error(lua);
  }
  if (machines.schedule().stopped() && lua_isyieldable(lua) != 0) return lua_yield(lua, 0);
  return results;
}

int start(lua_State* lua) {
  const Handle& self = checked(lua);
  if (self.machine->running()) refuse(lua, named(*self.machine) + " runs already");
  if (self.machine->acts()) {
    refuse(lua, named(*self.machine) + " cannot be started by an action of its own");
  }
  {
    const Machines::Lua lua_of_this_turn(*self.machines, lua);
    self.machine->start(lua);
  }
  return end_of_turn(lua, *self.machines, 0);
}

int stop(lua_State* lua) {
  const Handle& self = checked(lua);
  {
    const Machines::Lua lua_of_this_turn(*self.machines, lua);
    self.machine->stop();
  }
  return end_of_turn(lua, *self.machines, 0);
}

std::size_t trigger_at(lua_State* lua, const Machine& machine) {
  const MachineDefinition& definition = machine.definition();
  const std::string name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "";
  std::vector<std::string> known;
  for (std::size_t i = 0; i < definition.triggers.size(); ++i) {
    if (!definition.triggers[i].sendable) continue;
    if (definition.table.triggers[i] == name) return i;
    known.push_back(definition.table.triggers[i]);
  }
  if (lua_type(lua, 2) != LUA_TSTRING) {
    refuse(lua, "send takes a text, machine:send(\"go\"), found " +
                    (lua_isnoneornil(lua, 2) ? "nothing" : text_at(lua, 2)));
  }
  refuse(lua, named(machine) + ": no state has on = {" + name + " = ...}" +
                  base::suggestion_in_brackets(name, known));
}

/// Whether it had an effect; if not, why.
int send(lua_State* lua) {
  const Handle& self = checked(lua);
  const std::size_t trigger = trigger_at(lua, *self.machine);
  component::TriggerStatus status{};
  {
    const Machines::Lua lua_of_this_turn(*self.machines, lua);
    status = self.machine->send(trigger, keep_arguments(lua, lua_gettop(lua) - 2));
  }
  const bool taken = status >= component::TriggerStatus::kTaken;
  lua_pushboolean(lua, taken);
  if (!taken) lua_pushstring(lua, std::string(component::name_of(status)).c_str());
  return end_of_turn(lua, *self.machines, taken ? 1 : 2);
}

int is_in(lua_State* lua) {
  const Machine& machine = *checked(lua).machine;
  const component::MachineTable& table = machine.definition().table;
  const std::string name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "";
  if (table.find(name) == component::kNoState) {
    std::vector<std::string> known;
    for (int i = 0; i < static_cast<int>(table.states.size()); ++i) known.push_back(table.path(i));
    refuse(lua, named(machine) + " has no state '" + name + "'" +
                    base::suggestion_in_brackets(name, known));
  }
  lua_pushboolean(lua, machine.is_in(name));
  return 1;
}

constexpr luaL_Reg kMethods[] = {
    {"start", start}, {"stop", stop}, {"send", send}, {"is_in", is_in}, {nullptr, nullptr}};

void push_text(lua_State* lua, std::string_view text) {
  lua_pushlstring(lua, text.data(), text.size());
}

/// Upvalue: the methods.
int read_machine_member(lua_State* lua) {
  const Machine& machine = *checked(lua).machine;
  const std::string name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "";
  if (name == "state") {
    push_text(lua, machine.state());
  } else if (name == "name") {
    push_text(lua, machine.name());
  } else if (name == "running") {
    lua_pushboolean(lua, machine.running());
  } else if (lua_getfield(lua, lua_upvalueindex(1), name.c_str()) == LUA_TNIL) {
    refuse(lua, "a machine has no '" + name + "'" +
                    base::suggestion_in_brackets(
                        name, {"is_in", "name", "running", "send", "start", "state", "stop"}));
  }
  return 1;
}

int refuse_machine_write(lua_State* lua) {
  refuse(lua, "a machine has nothing to set: send it a text with machine:send(\"go\")");
}

int machine_text(lua_State* lua) {
  const Machine& machine = *checked(lua).machine;
  const std::string state(machine.state().empty() ? "not running" : machine.state());
  push_text(lua, named(machine) + " (" + state + ")");
  return 1;
}

std::string list_of(const std::vector<std::string>& problems) {
  if (problems.size() == 1) return ": " + problems.front();
  std::string text = " has " + std::to_string(problems.size()) + " mistakes:";
  for (const std::string& problem : problems) text += "\n  " + problem;
  return text;
}

}  // namespace

void Machines::install(lua_State* lua) {
  make_type(lua);
  lua_pushlightuserdata(lua, this);
  lua_pushcclosure(lua, &Machines::define, 1);
  lua_setglobal(lua, "machine");
}

void Machines::make_type(lua_State* lua) {
  luaL_newmetatable(lua, kMachine);
  luaL_newlib(lua, kMethods);
  lua_pushcclosure(lua, read_machine_member, 1);
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, refuse_machine_write);
  lua_setfield(lua, -2, "__newindex");
  lua_pushcfunction(lua, machine_text);
  lua_setfield(lua, -2, "__tostring");
  lua_pushliteral(lua, "machine");
  lua_setfield(lua, -2, "__metatable");
  lua_pop(lua, 1);
}

int Machines::define(lua_State* lua) {
  auto& machines = *static_cast<Machines*>(lua_touserdata(lua, lua_upvalueindex(1)));
  if (!lua_istable(lua, 1) || lua_gettop(lua) != 1) {
    refuse(lua, "machine takes a table of states: machine {initial = \"Idle\", Idle = {...}}");
  }
  if (machines.all_.size() >= kMostMachines) {
    refuse(
        lua,
        "a script has at most 100 machines: start one of them again instead of defining another");
  }
  MachineDefinition definition = read_machine(lua, 1);
  if (!definition.problems.empty()) {
    refuse(lua, "machine '" + definition.name + "'" + list_of(definition.problems));
  }
  auto* const handle = static_cast<Handle*>(lua_newuserdatauv(lua, sizeof(Handle), 0));
  auto machine = std::make_unique<Machine>(std::move(definition), machines);
  *handle = {&machines, machine.get()};
  machines.all_.push_back(std::move(machine));
  luaL_setmetatable(lua, kMachine);
  return 1;
}

// --- turns ---------------------------------------------------------------------------------------

base::Time Machines::next_due() const {
  base::Time due = base::Time::max();
  for (const auto& machine : all_) due = std::min(due, machine->next_due());
  return due;
}

bool Machines::step_next(lua_State* lua, base::Time instant) {
  for (const auto& machine : all_) {
    if (machine->next_due() > instant) continue;
    const Lua lua_of_this_turn(*this, lua);
    machine->step();
    return true;
  }
  return false;
}

void Machines::stop_all(lua_State* lua) {
  const Lua lua_of_this_turn(*this, lua);
  for (const auto& machine : all_) machine->stop();
}

// --- actions -------------------------------------------------------------------------------------

/// In a thread of Lua's own, so that `stop()` can end it.
bool Machines::call(Machine& machine, int function, int arguments) {
  bool answer = false;
  protect(machine, [&](lua_State* lua) {
    lua_State* const thread = lua_newthread(lua);
    lua_rawgeti(thread, LUA_REGISTRYINDEX, function);
    int count = 0;
    if (arguments != LUA_NOREF) {
      lua_rawgeti(thread, LUA_REGISTRYINDEX, arguments);
      count = static_cast<int>(lua_rawlen(thread, -1));
      luaL_checkstack(thread, count, "arguments");
      for (int i = 1; i <= count; ++i) lua_rawgeti(thread, 2, i);
      lua_remove(thread, 2);
    }
    const Lua inner(*this, thread);
    int results = 0;
    const int status = lua_resume(thread, lua, count, &results);
    if (status == LUA_OK) answer = results > 0 && lua_toboolean(thread, -results) != 0;
    if (status == LUA_OK || status == LUA_YIELD) return;  // it yields by `stop()` only
    lua_xmove(thread, lua, 1);
    lua_error(lua);
  });
  return answer;
}

void Machines::protect(Machine& machine, const std::function<void(lua_State*)>& code) {
  luaL_checkstack(lua_, 4, "actions");
  lua_pushcfunction(lua_, [](lua_State* lua) {
    (*static_cast<const std::function<void(lua_State*)>*>(lua_touserdata(lua, 1)))(lua);
    return 0;
  });
  lua_pushlightuserdata(lua_, const_cast<std::function<void(lua_State*)>*>(&code));
  if (lua_pcall(lua_, 1, 0, 0) == LUA_OK) return;
  const std::string text = text_at(lua_, -1);
  lua_pop(lua_, 1);
  note_mistake(text);
  machine.fault(text);
}

Machine* machine_at(lua_State* lua, int index) {
  void* const handle = luaL_testudata(lua, index, kMachine);
  return handle == nullptr ? nullptr : static_cast<Handle*>(handle)->machine;
}

/// `nil` among them is kept as false, so that the list has no gap.
int keep_arguments(lua_State* lua, int count) {
  if (count == 0) return LUA_NOREF;
  const int first = lua_gettop(lua) - count + 1;
  lua_createtable(lua, count, 0);
  lua_insert(lua, first);
  for (int i = count; i >= 1; --i) {
    if (lua_isnil(lua, -1)) {
      lua_pop(lua, 1);
      lua_pushboolean(lua, 0);
    }
    lua_rawseti(lua, first, i);
  }
  return luaL_ref(lua, LUA_REGISTRYINDEX);
}

}  // namespace armature::lua::internal
