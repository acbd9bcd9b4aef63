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

class Check;
class Host;
struct Interface;

namespace internal {
class Inside;
}  // namespace internal

/// Where a component is in its life (component-model: life cycle). Ordered so that everything from
/// kStopped on serves operations.
enum class State : std::uint8_t { kPreOperational, kException, kStopped, kRunning, kRunTimeError };

std::string_view name_of(State state);

/// The base of every component. Its interface consists of members (Property, InputPort, OutputPort,
/// Operation, Event, ...) that are constructed with `this` and so make themselves known.
///
/// All hooks of a component, its handlers and its own-thread operations run in one thread, one
/// after the other: none of them needs a lock. A constructor only declares; it touches no hardware,
/// since tools construct components to describe them.
///
/// This is what the author of a component uses. What runs components does so by `Host` (host.hpp).
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

  /// Takes the component out of service from within or by a declared reaction: kException, and what
  /// depends on it reacts as declared. In an operation that runs in its caller's thread it comes as
  /// a message.
  /// @rt nonblocking, no allocation
  /// @thread one that runs components, or the controlling one while none runs
  void fault(std::string_view reason);
  /// Stops by a declared reaction; the application is told.
  void stop_because(std::string_view reason);
  /// Ends its run in good order, from within or in its thread.
  /// @thread its own
  void stop();
  /// From kRunTimeError back to kRunning.
  /// @thread its own
  Outcome recover();

  /// The period with which it is run, as the plan knows it, from before it is configured on; 0 if
  /// the plan knows none, or two that differ (see `pace`).
  /// @rt nonblocking
  base::Duration period() const;
  const Pace& pace() const;
  /// Its time is simulated, so that it leaves hardware alone.
  /// @rt nonblocking
  /// @thread configuration, and its own
  bool is_simulated() const { return context_->simulated; }

  /// Looks at what the deployment makes of it: properties have their values, nothing is configured.
  /// Overridden by what has more to check than its declaration says; changes nothing.
  /// @thread configuration only
  virtual void on_check(Check& check) const;

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
  friend class Host;
  friend class CommandBase;  // logs in its component's name
  friend class internal::Inside;
  friend const Interface& interface_of(const Component& component);
  using LogArguments = std::array<rt::LogArgument, 4>;
  void log(rt::LogLevel level, const char* format, const LogArguments& arguments);

  /// What no handler touches. It lies apart, so that the members of the derived class lie close to
  /// what every handler touches: a cycle of many components is as fast as their data is small.
  struct Rest;

  ExecutionContext* context_;
  std::atomic<State> state_{State::kPreOperational};
  bool admits_at_once_ = false;
  bool aging_ = false;
  std::unique_ptr<Rest> rest_;
};

}  // namespace armature::component
