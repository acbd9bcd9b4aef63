// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::component {

/// Something that a state machine does: a function, what it is called with, its name for tools.
struct MachineAction {
  void (*call)(void* self) = nullptr;
  void* self = nullptr;
  std::string name;
};

/// Something that a state machine asks.
struct MachineGuard {
  bool (*call)(void* self) = nullptr;
  void* self = nullptr;
  std::string name;

  bool allows() const { return call == nullptr || call(self); }
};

/// Stands for "none" wherever the index of a state is expected.
inline constexpr int kNoState = -1;

/// A state of a machine's table, with its actions.
struct MachineState {
  std::string name;
  std::string doc;
  int parent = kNoState;
  bool final = false;
  MachineAction entry;
  MachineAction during;
  MachineAction exit;
};

/// A transition of a machine's table.
struct MachineTransition {
  /// What the transition waits for.
  enum class Cause : std::uint8_t {
    kTrigger,
    kTime,       ///< `after` has passed since the source was entered
    kCondition,  ///< `guard` is true
    kDone,       ///< a final substate of the source was entered
  };

  int source = kNoState;
  int target = kNoState;    ///< none: only the action is carried out, no state is left
  bool to_history = false;  ///< the target is entered where it was left last
  Cause cause = Cause::kTrigger;
  std::size_t trigger = 0;
  base::Duration after{};
  MachineGuard guard;
  MachineAction action;
};

/// A hierarchical state machine as data: the same whether a component or a script defines it.
struct MachineTable {
  /// A state comes after its parent. The first of several siblings is the initial one.
  std::vector<MachineState> states;
  /// Those of a state in the order in which they are tried.
  std::vector<MachineTransition> transitions;
  std::vector<std::string> triggers;

  /// `Moving/Decelerating`; empty for kNoState.
  std::string path(int state) const;
  /// The state that `name`, such as `Idle` or `Moving/Decelerating`, means in a transition of
  /// `from`: among its substates, else among its siblings, and so on outwards; kNoState if there is
  /// none.
  int find(std::string_view name, int from = kNoState) const;
  /// The initial substate, or the initial state of the machine for kNoState; kNoState if none.
  int initial(int state) const;
  /// True if `inner` lies somewhere inside `outer`; everything lies inside kNoState.
  bool contains(int outer, int inner) const;
  /// `Idle -> Moving on drive [is_free] / note`.
  std::string text(const MachineTransition& transition) const;
};

/// Everything that is wrong with a table, a sentence each; empty if nothing.
std::vector<std::string> check_table(const MachineTable& table);

}  // namespace armature::component
