// SPDX-License-Identifier: Apache-2.0
#pragma once

// How a thread comes to a component's code: what ports, operations and events compile into their
// calls. For all else that runs components: host.hpp.

#include <atomic>
#include <string_view>
#include <type_traits>

#include "armature/component/component.hpp"
#include "armature/component/context.hpp"
#include "armature/component/entrance.hpp"

namespace armature::component::internal {

/// The way into the code of components, and what happens to one whose code does not come back well.
class Inside {
 public:
  /// The runtime's side of what an author declared: of an `OutputPort<double>` its
  /// `OutputPortBase`.
  template <typename Declared>
  static auto& face(Declared& declared) {
    using Face = typename Declared::RuntimeFace;
    using Side = std::conditional_t<std::is_const_v<Declared>, const Face, Face>;
    return static_cast<Side&>(declared);
  }

  /// Of the thread that runs it.
  static ExecutionContext& context(const Component& component) { return *component.context_; }

  /// True if a handler may run now: the component runs, and no input's data is so old that the
  /// declared reaction takes it out of service. Looks at the ages once in each cycle.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  static bool admits(Component& component) noexcept {
    return component.admits_at_once_ || admits_after_look(component);
  }

  /// Runs `code` as the component's: what escapes from it faults this component and goes no
  /// further, and its time is this component's.
  /// @return false if an exception escaped
  /// @rt as the code is; itself a few nanoseconds
  template <typename Code>
  static bool run(Component& component, ExecutionContext& where, Code&& code) noexcept {
    where.flush();  // a hook or operation may take its time: nobody waits for it
    return run_handler(component, where, code);
  }
  /// The same for a handler, which is short: threads that are to be sent something wait for it.
  template <typename Code>
  static bool run_handler(Component& component, ExecutionContext& where, Code&& code) noexcept {
    if (where.measuring) [[unlikely]]
      charge(where, where.running());
    const bool completed = enter_hook(component, where, code);
    if (where.measuring) [[unlikely]]
      charge(where, &component);
    return completed;
  }

  // --- the same in two halves, for code of one component that runs code of another -------------
  /// The half of the one that calls `callee`: it accounts for the time.
  template <typename Code>
  static void call_out(Component& caller, Component& callee, Code&& code) noexcept {
    ExecutionContext& where = *caller.context_;
    if (where.measuring) [[unlikely]]
      charge(where, &caller);
    code();
    if (where.measuring) [[unlikely]]
      charge(where, &callee);
  }
  /// The half of the one that is called: what escapes from its hook or operation goes no further.
  template <typename Code>
  [[gnu::always_inline]] static bool enter_hook(Component& component, ExecutionContext& where,
                                                Code&& code) noexcept {
    HookEntrance* const place = where.next_hook;
    if (place == where.end_of_hooks) [[unlikely]] {
      refuse_depth(component, where);
      return false;
    }
    place->component_.store(&component, std::memory_order_relaxed);
    where.next_hook = place + 1;
    const bool completed = enter_handler(component, where, *place, place->outer_, code);
    where.next_hook = place;
    return completed;
  }
  /// The same for a handler that does not run yet.
  /// @param outer  where `through` keeps what was entered before
  template <typename Code>
  [[gnu::always_inline]] static bool enter_handler(Component& component, ExecutionContext& where,
                                                   const Entrance& through, const Entrance*& outer,
                                                   Code&& code) noexcept {
    const Entrance* const before = where.innermost.load(std::memory_order_relaxed);
    outer = before;
    where.innermost.store(&through, std::memory_order_relaxed);
    bool completed = true;
    try {
      code();
    } catch (...) {
      completed = false;
      contain(component, where);
    }
    where.innermost.store(before, std::memory_order_relaxed);
    return completed;
  }

  /// Faults at once in the component's own thread, else by a message to it: its state, its commands
  /// and its log belong to that thread.
  static void fault_from(Component& component, const ExecutionContext& where,
                         std::string_view reason);

 protected:
  friend class component::Component;
  /// A fault that happened in another thread, on its way to the component's own.
  struct ReportedFault;

  /// Where a component lives before an application gave it a thread.
  static ExecutionContext& no_context();
  /// Adds the time since the last mark to `ran`, which may be nobody.
  static void charge(ExecutionContext& where, Component* ran) noexcept;
  /// Faults because of the exception that is being handled.
  static void contain(Component& component, ExecutionContext& where) noexcept;
  static void refuse_depth(Component& component, ExecutionContext& where) noexcept;
  static void enter_fault(Component& component, std::string_view reason);
  static void enter(Component& component, State state);
  static void set_at_once(Component& component, bool on);
  static bool admits_after_look(Component& component) noexcept;
  static void check_ages(Component& component);
  static void tell_readers_lost(Component& component);
  static void halt_steps(Component& component, std::string_view why);
};

}  // namespace armature::component::internal
