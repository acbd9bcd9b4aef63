// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/states/state_machine.hpp"
#include "armature/component/trigger.hpp"
#include "armature/lua/internal/events.hpp"
#include "armature/lua/internal/machine_definition.hpp"

namespace armature::lua::internal {

class Machines;

/// A state machine whose actions are functions of Lua: the core is that of components, and it has
/// one of its own, which is in no application.
class Machine {
 public:
  /// @param definition  without problems
  Machine(MachineDefinition definition, Machines& machines);
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  const MachineDefinition& definition() const { return definition_; }
  const std::string& name() const { return definition_.name; }
  /// `Looking/Left`; empty before the start and after the stop.
  std::string_view state() const { return machine_.path(); }
  bool is_in(std::string_view state) const { return machine_.is_in(state); }
  /// Started, not stopped, and not at its end.
  bool running() const { return owner_.state() == component::State::kRunning && !at_end(); }
  /// In a final state that lies in no other.
  bool at_end() const;
  /// One of its actions runs.
  bool acts() const { return turns_ > 0; }

  // --- where errors of Lua end it; what Lua did wrong is told to the machines ------------------
  void start(lua_State* lua);
  void stop();
  /// @param arguments  a reference to a list of them, or LUA_NOREF
  component::TriggerStatus send(std::size_t trigger, int arguments);
  void step();

  /// When it is to be stepped next; the end of time if it waits for triggers only.
  base::Time next_due() const;

  /// What a transition or state calls.
  void perform(const MachineFunction& function);
  bool ask(const MachineFunction& function);
  /// Takes it out of service.
  void fault(std::string_view reason) { owner_.fault(reason); }

 private:
  class Turn;

  void listen(lua_State* lua);
  void stop_listening();
  void enter(int state);
  void leave(int state);
  /// Of the state; with a mistake if it did not come to its end.
  bool run_ended(lua_State* lua, int state, const std::string* mistake);
  bool call(const MachineFunction& function);
  void end_turn();

  MachineDefinition definition_;
  Machines& machines_;
  component::ExecutionContext context_;
  component::Component owner_;
  component::StateMachine machine_;
  std::vector<std::vector<base::Duration>> afters_;  ///< by state
  std::vector<bool> periodic_;                       ///< states that are looked at in each period
  std::vector<base::Time> entered_at_;
  std::vector<const lua_State*> runs_;  ///< by state, while they are under way
  std::vector<int> arguments_;          ///< by trigger, of the last one
  std::vector<Events::Id> listeners_;
  base::Time next_period_{};
  base::Time stepped_at_{};
  bool fault_told_ = false;
  int turns_ = 0;  ///< within one another
};

}  // namespace armature::lua::internal
