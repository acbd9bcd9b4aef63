// SPDX-License-Identifier: Apache-2.0
#pragma once

// What runs a component does with it. Authors of components do not need it.

#include <string_view>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/face.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/internal/inside.hpp"
#include "armature/component/step.hpp"
#include "armature/rt/forward.hpp"

namespace armature::component {

/// The runtime's side of every component: its life cycle, its thread, its cycles, its measurements.
/// With what it inherits it also runs code as a component's (`run`, `call_out`, `enter_handler`).
class Host : public internal::Inside {
 public:
  /// The transitions of the life cycle; each runs its hook. A refusal leaves the state as it was.
  /// @thread the component's own; before the application runs, the one that builds it
  static Outcome configure(Component& component);
  static Outcome activate(Component& component);
  static Outcome start(Component& component);
  static void stop(Component& component);
  static void cleanup(Component& component);
  static Outcome recover(Component& component);  ///< from kRunTimeError back to kRunning
  static void retire(Component& component);      ///< at the application's end: also after a fault
  /// From kException to kStopped; to kPreOperational if it was not configured.
  static Outcome reset(Component& component);

  /// One cycle: state machines, the update hook (or the error hook), then commands under way.
  /// @rt as the hooks are
  static void update(Component& component);

  static bool has_aging_inputs(const Component& component) { return component.aging_; }
  /// One of its inputs has an age from now on, or a writer.
  /// @thread configuration only
  static void note_aging_input(Component& component);
  /// Lets handlers run without a look at the ages for as long as no input's data can be too old.
  /// @return the end of that time: the end of time if it does not run; before `time()` if there is
  ///         something too old, or may be at any time: then `admits` looks
  /// @rt nonblocking, no allocation, O(inputs)
  /// @thread its own
  static base::Time settle_ages(Component& component);
  /// When the reaction to old data of an input is due if nothing new comes; the end of time if none
  /// is.
  /// @rt nonblocking, no allocation, O(inputs)
  /// @thread its own
  static base::Time next_expiry(const Component& component);

  /// Told by the plan.
  /// @thread configuration only
  static void set_pace(Component& component, const Pace& pace);
  /// Gives the component a thread; nothing is on its way in the one before.
  /// @thread configuration only
  static void assign_context(Component& component, ExecutionContext& context);

  /// The declaration lists, for the members that enter themselves.
  static Interface& declare(Component& component);
  static void add_step(Component& component, Step& step, bool before_update);
  static void remove_step(Component& component, Step& step);

  /// Execution time of the component in each measured cycle, in ticks, without what it called.
  static const rt::Distribution& execution_ticks(const Component& component);
  /// Adds up a measured cycle of all that ran in it.
  /// @rt nonblocking, no allocation, O(components that ran)
  /// @thread the context's
  static void close_measurements(ExecutionContext& where);

 private:
  using Hook = Outcome (Component::*)();
  static Outcome run_hook(Component& component, Hook hook, State next);
  static Outcome wrong_state(const Component& component, std::string_view transition);
};

}  // namespace armature::component
