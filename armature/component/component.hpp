// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/context.hpp"
#include "armature/component/entrance.hpp"
#include "armature/component/internal/side_by_side.hpp"
#include "armature/component/outcome.hpp"
#include "armature/component/pace.hpp"
#include "armature/rt/forward.hpp"
#include "armature/rt/log_argument.hpp"

namespace armature::component {

class PropertyBase;
class InputPortBase;
class OutputPortBase;
class PortArrayBase;
class OperationBase;
class OperationCallerBase;
class EventBase;
class EventHandlerBase;
class StateMachine;
class Observer;
class Check;
class Checked;
class Holding;

/// Where a component is in its life (component-model: life cycle). Ordered so that everything from
/// kStopped on serves operations.
enum class State : std::uint8_t { kPreOperational, kException, kStopped, kRunning, kRunTimeError };

std::string_view name_of(State state);

/// Something a component does around its update hook: a state machine, a command under way.
class Step {
 public:
  virtual void step() = 0;
  /// The component was stopped or faulted: what was under way is over.
  virtual void halt(std::string_view reason) = 0;
  virtual void start() {}

 protected:
  ~Step() = default;
};

/// What a component declares, in the order of declaration.
struct Interface {
  std::vector<PropertyBase*> properties;
  std::vector<PropertyBase*> mandatory;  ///< those of them that a deployment must give
  std::vector<InputPortBase*> inputs;
  std::vector<OutputPortBase*> outputs;
  std::vector<PortArrayBase*> port_arrays;
  std::vector<OperationBase*> operations;
  std::vector<OperationCallerBase*> callers;
  std::vector<EventBase*> events;
  std::vector<EventHandlerBase*> handlers;
  std::vector<StateMachine*> machines;
  std::vector<Observer*> observers;
  std::vector<const Checked*> checked;
  std::vector<Holding*> holdings;
};

/// The base of every component. Its interface consists of members (Property, InputPort, OutputPort,
/// Operation, Event, ...) that are constructed with `this` and so make themselves known.
///
/// All hooks of a component, its handlers and its own-thread operations run in one thread, one
/// after the other: none of them needs a lock. A constructor only declares; it touches no hardware,
/// since tools construct components to describe them.
class Component {
 public:
  explicit Component(std::string name);
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  virtual ~Component();

  static void* operator new(std::size_t size) { return internal::allocate_side_by_side(size); }
  static void operator delete(void* at, std::size_t size) { internal::free_side_by_side(at, size); }

  const std::string& name() const;
  /// @thread any
  State state() const { return state_.load(std::memory_order_acquire); }
  /// Serves operations: configured and without an exception.
  bool ready() const { return state() >= State::kStopped; }
  /// From its configuration to its clean-up, also behind an exception.
  /// @thread its own, or any while it does not run
  bool is_configured() const;
  /// Why the component is in its state after a refusal, an error or a fault; empty if all is well.
  /// @thread its own, or any while it does not run
  std::string_view reason() const;

  /// The cycle time of the thread: one value for everything that happens in a cycle.
  /// @rt nonblocking
  base::Time time() const { return context_->cycle_time.load(std::memory_order_relaxed); }

  /// The transitions of the life cycle; each runs its hook. A refusal leaves the state as it was.
  /// @thread the component's own; before the application runs, the one that builds it
  Outcome configure();
  Outcome activate();
  Outcome start();
  void stop();
  void cleanup();
  Outcome recover();  ///< from kRunTimeError back to kRunning
  void retire();      ///< at the application's end: cleans up also after a fault
  Outcome reset();    ///< from kException to kStopped; to kPreOperational if it was not configured

  /// One cycle: state machines, the update hook (or the error hook), then commands under way.
  /// @rt as the hooks are
  void update();

  /// Takes the component out of service from within or by a declared reaction: kException, and what
  /// depends on it reacts as declared. In an operation that runs in its caller's thread it comes as
  /// a message.
  /// @rt nonblocking, no allocation
  /// @thread one that runs components, or the controlling one while none runs
  void fault(std::string_view reason);
  /// Stops by a declared reaction; the application is told.
  void stop_because(std::string_view reason);

  /// True if a handler may run now: the component runs, and no input's data is so old that the
  /// declared reaction takes it out of service. Looks at the ages once in each cycle.
  /// @rt nonblocking, no allocation
  /// @thread its own
  bool admits() noexcept { return admits_at_once_ || admits_after_look(); }
  bool has_aging_inputs() const { return aging_; }
  /// One of its inputs has an age from now on, or a writer.
  /// @thread configuration only
  void note_aging_input();
  /// Lets handlers run without a look at the ages for as long as no input's data can be too old.
  /// @return the end of that time: the end of time if it does not run; before `time()` if there is
  ///         something too old, or may be at any time: then `admits` looks
  /// @rt nonblocking, no allocation, O(inputs)
  /// @thread its own
  base::Time settle_ages();
  /// When the reaction to old data of an input is due if nothing new comes; the end of time if none
  /// is.
  /// @rt nonblocking, no allocation, O(inputs)
  /// @thread its own
  base::Time next_expiry() const;

  /// The period with which it is run, as the plan knows it, from before it is configured on; 0 if
  /// the plan knows none, or two that differ (see `pace`).
  /// @rt nonblocking
  base::Duration period() const;
  const Pace& pace() const;
  /// Told by the plan.
  /// @thread configuration only
  void set_pace(const Pace& pace);

  /// Looks at what the deployment makes of it: properties have their values, nothing is configured.
  /// Overridden by what has more to check than its declaration says; changes nothing.
  /// @thread configuration only
  virtual void on_check(Check& check) const;

  const Interface& interface() const;
  /// The declaration lists, for the members that enter themselves.
  Interface& declare();
  void add_step(Step& step, bool before_update);
  void remove_step(Step& step);

  ExecutionContext& context() const { return *context_; }
  /// Gives the component a thread; nothing is on its way in the one before.
  void assign_context(ExecutionContext& context);

  /// Execution time of the component in each measured cycle, in ticks, without what it called.
  const rt::Distribution& execution_ticks() const;
  /// Adds up a measured cycle of all that ran in it.
  /// @rt nonblocking, no allocation, O(components that ran)
  /// @thread the context's
  static void close_measurements(ExecutionContext& where);

  /// Runs `code` as this component's: what escapes from it faults this component and goes no
  /// further, and its time is this component's.
  /// @return false if an exception escaped
  /// @rt as the code is; itself a few nanoseconds
  template <typename Code>
  bool run(ExecutionContext& where, Code&& code) noexcept {
    where.flush();  // a hook or operation may take its time: nobody waits for it
    return run_handler(where, code);
  }
  /// The same for a handler, which is short: threads that are to be sent something wait for it.
  template <typename Code>
  bool run_handler(ExecutionContext& where, Code&& code) noexcept {
    if (where.measuring) [[unlikely]]
      charge(where, where.running());
    const bool completed = enter_hook(where, code);
    if (where.measuring) [[unlikely]]
      charge(where, this);
    return completed;
  }

  // --- the same in two halves, for code of one component that runs code of another -------------
  /// The half of the one that calls `callee`: it accounts for the time.
  template <typename Code>
  void call_out(Component& callee, Code&& code) noexcept {
    ExecutionContext& where = *context_;
    if (where.measuring) [[unlikely]]
      charge(where, this);
    code();
    if (where.measuring) [[unlikely]]
      charge(where, &callee);
  }
  /// The half of the one that is called: what escapes from its hook or operation goes no further.
  template <typename Code>
  [[gnu::always_inline]] bool enter_hook(ExecutionContext& where, Code&& code) noexcept {
    HookEntrance* const place = where.next_hook;
    if (place == where.end_of_hooks) [[unlikely]] {
      refuse_depth(where);
      return false;
    }
    place->component_.store(this, std::memory_order_relaxed);
    where.next_hook = place + 1;
    const bool completed = enter_handler(where, *place, place->outer_, code);
    where.next_hook = place;
    return completed;
  }
  /// The same for a handler that does not run yet.
  /// @param outer  where `through` keeps what was entered before
  template <typename Code>
  [[gnu::always_inline]] bool enter_handler(ExecutionContext& where, const Entrance& through,
                                            const Entrance*& outer, Code&& code) noexcept {
    const Entrance* const before = where.innermost.load(std::memory_order_relaxed);
    outer = before;
    where.innermost.store(&through, std::memory_order_relaxed);
    bool completed = true;
    try {
      code();
    } catch (...) {
      completed = false;
      contain(where);
    }
    where.innermost.store(before, std::memory_order_relaxed);
    return completed;
  }

 protected:
  virtual Outcome on_configure() { return accepted(); }
  virtual Outcome on_activate() { return accepted(); }
  virtual Outcome on_start() { return accepted(); }
  virtual void on_update() {}
  virtual void on_stop() {}
  virtual void on_cleanup() {}
  virtual void on_error() {}
  virtual Outcome on_reset() { return accepted(); }

  /// From kRunning to kRunTimeError: the error hook runs in place of the update hook.
  /// @rt nonblocking, no allocation
  /// @thread its own
  void error(std::string_view reason);

  /// Log lines; `format` is a literal with `{}` for each of at most four arguments.
  /// @rt nonblocking, no allocation: becomes text in another thread
  template <typename... Arguments>
  void log_debug(const char* format, const Arguments&... arguments) {
    log(rt::LogLevel::kDebug, format, {rt::LogArgument(arguments)...});
  }
  template <typename... Arguments>
  void log_info(const char* format, const Arguments&... arguments) {
    log(rt::LogLevel::kInfo, format, {rt::LogArgument(arguments)...});
  }
  template <typename... Arguments>
  void log_warning(const char* format, const Arguments&... arguments) {
    log(rt::LogLevel::kWarning, format, {rt::LogArgument(arguments)...});
  }
  template <typename... Arguments>
  void log_error(const char* format, const Arguments&... arguments) {
    log(rt::LogLevel::kError, format, {rt::LogArgument(arguments)...});
  }

 private:
  friend class Entrance;
  friend class CommandBase;  // logs in its component's name
  using LogArguments = std::array<rt::LogArgument, 4>;
  void log(rt::LogLevel level, const char* format, const LogArguments& arguments);
  /// Adds the time since the last mark to `ran`, which may be nobody.
  static void charge(ExecutionContext& where, Component* ran) noexcept;
  /// Faults because of the exception that is being handled.
  void contain(ExecutionContext& where) noexcept;
  void refuse_depth(ExecutionContext& where) noexcept;
  void enter_fault(std::string_view reason);
  void fault_from(const ExecutionContext& where, std::string_view reason);
  void enter(State state);
  void set_at_once(bool on);
  bool admits_after_look() noexcept;
  void check_ages();
  void tell_readers_lost();
  void halt_steps(std::string_view why);
  Outcome run_hook(Outcome (Component::*hook)(), State next);
  Outcome wrong_state(std::string_view transition) const;

  /// What no handler touches. It lies apart, so that the members of the derived class lie close to
  /// what every handler touches: a cycle of many components is as fast as their data is small.
  struct Rest;
  /// A fault that happened in another thread, on its way to the component's own.
  struct ReportedFault;

  ExecutionContext* context_;
  std::atomic<State> state_{State::kPreOperational};
  bool admits_at_once_ = false;
  bool aging_ = false;
  std::unique_ptr<Rest> rest_;
};

}  // namespace armature::component
