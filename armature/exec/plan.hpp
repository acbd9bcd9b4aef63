// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::exec {

/// Components are referred to by their index in the blueprint.
using Index = std::size_t;
inline constexpr Index kNone = static_cast<Index>(-1);

/// A connection with its ends found.
struct ConnectionPlan {
  Index from;
  Index to;
  component::OutputPortBase* output;
  component::InputPortBase* input;
  const ConnectionEntry* entry;
  // Known from the ports and the entry; here as well, since every step of planning asks for it and
  // those of ten thousand components lie far apart.
  bool triggers;  ///< data runs a handler of the reader
  bool delayed;   ///< by one cycle
  bool reacts;    ///< the entry declares an age or what happens to the reader of a lost writer
};

/// An event and a handler of it.
struct SubscriptionPlan {
  Index from;
  Index to;
  component::EventBase* event;
  component::EventHandlerBase* handler;
};

/// A caller of an operation and the operation.
struct CallPlan {
  Index caller;
  Index callee;
  component::OperationCallerBase* requirement;
  component::OperationBase* operation;
};

/// One thread: its activity, and the components that run in it.
struct ThreadPlan {
  std::string name;
  Activity activity;
  std::vector<Index> updating;  ///< whose update the thread runs in a cycle, in this order
  std::vector<Index> members;   ///< all that run in it, guests included, in the order of the flow
  base::Duration trigger_period{};  ///< of a triggered thread: how often it is triggered, if known
  int depth = 1;  ///< how many handlers may set each other off, one within the other
};

/// A mode's place among the modes, as a bit: whether a component runs in it.
using ModeSet = std::uint64_t;
inline constexpr std::size_t kMostModes = 64;

/// What one mode has that another one has not.
struct ModePlan {
  std::string name;
  std::vector<Index> members;  ///< that not all modes have, in the order of start
};

/// A component that drives what is not simulated.
struct HardwarePlan {
  const component::Component* component;
  std::string bus;
};

/// Everything that starting an application needs to know; made by `make_plan`, which changes
/// nothing of the components but the period that they know.
struct Plan {
  std::vector<ConnectionPlan> connections;
  std::vector<SubscriptionPlan> subscriptions;  ///< in the order of notification
  std::vector<CallPlan> calls;
  std::vector<ThreadPlan> threads;
  std::vector<Index> thread_of;    ///< for each component
  std::vector<Index> observers;    ///< components that look at others
  std::vector<Index> start_order;  ///< observers, then writers before readers
  std::vector<ModePlan> modes;
  std::size_t initial_mode = 0;
  std::vector<ModeSet> modes_of;  ///< for each component: all bits unless modes name it
  std::vector<HardwarePlan> hardware;
  std::vector<component::InputPortBase*> in_turns;  ///< whose writers take turns

  std::size_t service_thread() const { return threads.size() - 1; }
  bool run_together(Index a, Index b) const { return (modes_of[a] & modes_of[b]) != 0; }
  bool runs_at_start(Index component) const {
    return (modes_of[component] >> initial_mode & 1) != 0;
  }
};

/// Resolves every name, checks everything that can be known before start, assigns threads and
/// orders, and tells the components their periods. Finds all mistakes in one run, but has
/// components check themselves only if there is none; the plan is to be used only if there is no
/// error.
Plan make_plan(const Blueprint& blueprint, base::Diagnostics& diagnostics);

/// For people: each thread with its components in order of execution, and how they are reached.
std::string describe_order(const Blueprint& blueprint, const Plan& plan);

}  // namespace armature::exec
