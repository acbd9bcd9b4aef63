// SPDX-License-Identifier: Apache-2.0
#pragma once

// How a component's author writes a state machine:
//
//     OperationTrigger drive_{this, "drive", "starts to move"};
//     OperationTrigger halt_{this, "halt", "brakes"};
//     StateMachine mode_{
//         this, "mode", "what the chassis is doing",
//         in_state("Idle", entering<&Chassis::brake>,
//                  on(drive_, guarded_by<&Chassis::is_free>, to("Moving"))),
//         in_state("Moving", leaving<&Chassis::brake>,
//                  on(halt_, to("Idle")),
//                  in_state("Accelerating", during<&Chassis::speed_up>,
//                           when<&Chassis::at_speed>(to("Cruising"))),
//                  in_state("Cruising", after(5s, to("Idle"))))};

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/face.hpp"
#include "armature/component/internal/inside.hpp"
#include "armature/component/operations/signature.hpp"
#include "armature/component/states/machine_table.hpp"

namespace armature::component {

class EventBase;
template <typename... Args>
class Event;
class Trigger;

/// Options of a state, all of them `void f()` of the component.
template <auto Function>
struct Entering {};
template <auto Function>
inline constexpr Entering<Function> entering{};
/// Option of a state: what it does in each cycle.
template <auto Function>
struct During {};
template <auto Function>
inline constexpr During<Function> during{};
/// Option of a state: what it does when it is left.
template <auto Function>
struct Leaving {};
template <auto Function>
inline constexpr Leaving<Function> leaving{};
/// Option of a state: when it is entered, the state around it is done.
struct FinalState {};
inline constexpr FinalState final_state{};

/// Options of a transition.
struct To {
  std::string_view state;
  bool history;
};
/// The state to go to: a substate of the source, else a state beside it, and so on outwards; or a
/// path `Moving/Cruising` that begins with such a state. Without it nothing is left or entered.
inline To to(std::string_view state) { return {state, false}; }
/// The same, but on to the substate that was active when the state was left last.
inline To back_to(std::string_view state) { return {state, true}; }
/// `bool f()`: the transition is only taken if it is true.
template <auto Function>
struct GuardedBy {};
template <auto Function>
inline constexpr GuardedBy<Function> guarded_by{};
/// `void f()`: carried out between leaving and entering.
template <auto Function>
struct Doing {};
template <auto Function>
inline constexpr Doing<Function> doing{};

namespace internal {

/// The last part of the name of what `signature`, a __PRETTY_FUNCTION__, was instantiated with.
std::string function_name(std::string_view signature);

template <auto Function>
std::string_view signature_of() noexcept {
  return __PRETTY_FUNCTION__;
}

/// The name of an action or condition is read from the signature.
void set(MachineAction& action, void (*call)(void* self), std::string_view signature) noexcept;
void set(MachineGuard& guard, bool (*call)(void* self), std::string_view signature) noexcept;

template <auto Function>
void set(MachineAction& action) noexcept {
  using Owner = OwnerOf<Function>;
  static_assert(std::is_invocable_v<decltype(Function), Owner&>,
                "an action of a state machine is a member function without arguments");
  set(
      action, [](void* self) { (static_cast<Owner&>(*static_cast<Component*>(self)).*Function)(); },
      signature_of<Function>());
}

template <auto Function>
void set(MachineGuard& guard) noexcept {
  using Owner = OwnerOf<Function>;
  static_assert(std::is_invocable_r_v<bool, decltype(Function), Owner&>,
                "a condition of a state machine is bool f() of the component");
  set(
      guard,
      [](void* self) -> bool {
        return (static_cast<Owner&>(*static_cast<Component*>(self)).*Function)();
      },
      signature_of<Function>());
}

}  // namespace internal

/// A transition before its names are looked up; made by `on`, `after`, `when` and `when_done`.
struct TransitionDefinition {
  explicit TransitionDefinition(MachineTransition::Cause cause) noexcept;
  TransitionDefinition(const TransitionDefinition&);
  TransitionDefinition(TransitionDefinition&&) noexcept;
  ~TransitionDefinition();

  MachineTransition transition;
  std::string target;
  Trigger* trigger = nullptr;
  EventBase* event = nullptr;

  void apply(To option) noexcept;
  template <auto Function>
  void apply(GuardedBy<Function>) noexcept {
    internal::set<Function>(transition.guard);
  }
  template <auto Function>
  void apply(Doing<Function>) noexcept {
    internal::set<Function>(transition.action);
  }
};

/// On a trigger: one raised by the component, by a call of an operation, or by a peer's event.
/// Options of all transitions: to, back_to, guarded_by<&X::f>, doing<&X::f>.
template <typename... Options>
TransitionDefinition on(Trigger& trigger, Options... options) noexcept {
  TransitionDefinition definition(MachineTransition::Cause::kTrigger);
  definition.trigger = &trigger;
  (definition.apply(options), ...);
  return definition;
}
/// On an event that the component itself raises.
template <typename... Args, typename... Options>
TransitionDefinition on(Event<Args...>& event, Options... options) noexcept {
  TransitionDefinition definition(MachineTransition::Cause::kTrigger);
  definition.event = &internal::Inside::face(event);
  (definition.apply(options), ...);
  return definition;
}
/// In the first step in which the state has been active for `duration`, by the cycle's time.
template <typename... Options>
TransitionDefinition after(base::Duration duration, Options... options) noexcept {
  TransitionDefinition definition(MachineTransition::Cause::kTime);
  definition.transition.after = duration;
  (definition.apply(options), ...);
  return definition;
}
/// `bool f()`, asked in each step.
template <auto Function, typename... Options>
TransitionDefinition when(Options... options) noexcept {
  TransitionDefinition definition(MachineTransition::Cause::kCondition);
  (definition.apply(options), ...);
  internal::set<Function>(definition.transition.guard);
  return definition;
}
/// Once a final substate is entered.
template <typename... Options>
TransitionDefinition when_done(Options... options) noexcept {
  TransitionDefinition definition(MachineTransition::Cause::kDone);
  (definition.apply(options), ...);
  return definition;
}

/// A state before its names are looked up; made by `in_state`.
struct StateDefinition {
  explicit StateDefinition(std::string_view name) noexcept;
  StateDefinition(const StateDefinition&);
  StateDefinition(StateDefinition&&) noexcept;
  ~StateDefinition();

  MachineState state;
  std::vector<StateDefinition> substates;
  std::vector<TransitionDefinition> transitions;

  void apply(std::string_view doc) noexcept;
  void apply(FinalState) noexcept { state.final = true; }
  void apply(StateDefinition&& substate) noexcept;
  void apply(TransitionDefinition&& transition) noexcept;
  template <auto Function>
  void apply(Entering<Function>) noexcept {
    internal::set<Function>(state.entry);
  }
  template <auto Function>
  void apply(During<Function>) noexcept {
    internal::set<Function>(state.during);
  }
  template <auto Function>
  void apply(Leaving<Function>) noexcept {
    internal::set<Function>(state.exit);
  }
};

/// A state, and what is in it. Parts: its documentation, entering<&X::f>, during<&X::f>,
/// leaving<&X::f>, final_state, transitions, substates.
template <typename... Parts>
StateDefinition in_state(std::string_view name, Parts... parts) noexcept {
  StateDefinition definition(name);
  (definition.apply(std::move(parts)), ...);
  return definition;
}

}  // namespace armature::component
