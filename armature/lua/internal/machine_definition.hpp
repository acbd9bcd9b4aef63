// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/base/time.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/states/machine_table.hpp"

namespace armature::lua::internal {

class Machine;

inline constexpr std::size_t kNoTrigger = std::numeric_limits<std::size_t>::max();

/// What a state machine calls that Lua defines.
struct MachineFunction {
  enum class Kind : std::uint8_t { kEntry, kDuring, kExit, kTransition };
  Kind kind = Kind::kTransition;
  int reference = LUA_NOREF;  ///< of the function in Lua, which may be missing
  int state = component::kNoState;
  std::size_t trigger = kNoTrigger;  ///< whose arguments it is given
  Machine* machine = nullptr;

  /// As tables of machines have it; `self` is the function.
  static void perform(void* self);
  static bool ask(void* self);
};

/// A state machine as a table of Lua describes it.
struct MachineDefinition {
  struct Trigger {
    component::EventBase* event = nullptr;  ///< that raises it
    bool sendable = false;
  };
  struct State {
    int run = LUA_NOREF;
    std::size_t done = kNoTrigger;  ///< what the end of `run` raises
  };

  std::string name = "machine";
  base::Duration period = std::chrono::milliseconds(100);
  component::MachineTable table;
  std::vector<Trigger> triggers;  ///< those of the table
  std::vector<State> states;      ///< those of the table
  std::size_t failed = kNoTrigger;
  std::deque<MachineFunction> functions;  ///< stay where they are
  bool knows_all_ways = true;             ///< false if a name means no state
  std::vector<std::string> problems;      ///< everything that is wrong with it
};

/// Reads the table at `index`. What is wrong does not end it, but is among the problems.
MachineDefinition read_machine(lua_State* lua, int index);

}  // namespace armature::lua::internal
