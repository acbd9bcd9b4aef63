// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/base/time.hpp"
#include "armature/lua/internal/machine.hpp"

namespace armature::lua::internal {

class Schedule;

/// The state machines of a script. They are gone with it, not before: tools may look at them.
class Machines {
 public:
  explicit Machines(Schedule& schedule) : schedule_(schedule) {}
  Machines(const Machines&) = delete;
  Machines& operator=(const Machines&) = delete;

  /// Gives Lua `machine`.
  void install(lua_State* lua);

  const std::vector<std::unique_ptr<Machine>>& all() const { return all_; }
  base::Time next_due() const;
  /// Steps the first that is due at `instant`; false if none is.
  bool step_next(lua_State* lua, base::Time instant);
  /// Leaves all states of all.
  void stop_all(lua_State* lua);

  /// What went wrong in an action since it was asked last.
  std::optional<std::string> take_mistake() { return std::exchange(mistake_, std::nullopt); }
  void note_mistake(const std::string& text) {
    if (!mistake_) mistake_ = text;
  }

  // --- for a machine -----------------------------------------------------------------------------
  /// The Lua in which its actions run while this lives.
  class Lua {
   public:
    Lua(Machines& machines, lua_State* lua)
        : machines_(machines), before_(std::exchange(machines.lua_, lua)) {}
    Lua(const Lua&) = delete;
    Lua& operator=(const Lua&) = delete;
    ~Lua() { machines_.lua_ = before_; }

   private:
    Machines& machines_;
    lua_State* before_;
  };

  Schedule& schedule() const { return schedule_; }
  lua_State* lua() const { return lua_; }
  /// Calls a function of Lua with kept arguments; true if it gave what counts as true. A mistake is
  /// noted, and the machine's fault.
  bool call(Machine& machine, int function, int arguments);
  /// Likewise what may end by an error of Lua.
  void protect(Machine& machine, const std::function<void(lua_State*)>& code);

 private:
  static int define(lua_State* lua);
  void make_type(lua_State* lua);

  Schedule& schedule_;
  lua_State* lua_ = nullptr;
  std::vector<std::unique_ptr<Machine>> all_;
  std::optional<std::string> mistake_;
};

/// nullptr if there is none at `index`.
Machine* machine_at(lua_State* lua, int index);

/// A reference to a list of so many values, which are taken from the stack.
int keep_arguments(lua_State* lua, int count);

}  // namespace armature::lua::internal
