// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/entrance.hpp"
#include "armature/rt/forward.hpp"

namespace armature::component {

class BlackBox;
class Component;
class CycleRecord;
class Timeline;

/// Told by components of what the application must react to.
/// @rt both functions are called on real-time threads
class Supervisor {
 public:
  virtual void component_faulted(Component& component) = 0;
  virtual void component_stopped_itself(Component& component) = 0;

 protected:
  ~Supervisor() = default;
};

/// So deep hooks and operations may always nest in one thread.
inline constexpr int kLeastDepthLimit = 64;

/// The way of data to another thread (lanes.hpp).
struct LaneTo;

/// The thread that runs a component, as far as the component needs to know it. The execution engine
/// owns it; all components that share a thread share its context.
struct ExecutionContext {
 private:
  struct Mail;
  std::unique_ptr<Mail> mail_;  ///< what it exchanges with other threads

 public:
  explicit ExecutionContext(std::string context_name);
  ExecutionContext(const ExecutionContext&) = delete;
  ExecutionContext& operator=(const ExecutionContext&) = delete;
  ~ExecutionContext();

  std::string name;
  std::atomic<base::Time> cycle_time{base::Time{}};  ///< read from the clock once in each cycle
  std::uint64_t cycle = 0;                           ///< counts the cycles
  base::Duration period{};                           ///< of its cycles; 0: it is triggered
  std::atomic<const Entrance*> innermost{nullptr};   ///< through which the present code was entered
  std::unique_ptr<HookEntrance[]> hooks;             ///< those that are entered, and room for more
  HookEntrance* next_hook = nullptr;
  HookEntrance* end_of_hooks = nullptr;
  bool ages_to_settle = false;    ///< a component began to run, or has other ages than before
  bool measuring = false;         ///< this cycle's execution times are taken for each component
  std::uint64_t mark = 0;         ///< tick at which another one began to run, while measuring
  Component* measured = nullptr;  ///< the first of those that ran while measuring
  BlackBox* black_box = nullptr;  ///< keeps what happens; nullptr: nobody asked
  Timeline* timeline = nullptr;   ///< gets what is measured as well; nullptr: nobody asked
  CycleRecord* record = nullptr;  ///< likewise, of this cycle alone
  std::exception_ptr caught;      ///< the last one, kept: to let go of it frees memory
  /// The thread runs cycles: others reach its components by messages.
  std::atomic<bool> live{false};
  bool simulated = false;  ///< several contexts take turns in one thread
  bool real_time = false;  ///< it asks for a real-time scheduler: its components wait for nobody
  std::atomic<bool> wakes_on_messages{false};
  rt::Inbox& inbox;       ///< empty when components of this context are disconnected or destroyed
  rt::Inbox& next_cycle;  ///< to be delivered first in the next cycle
  rt::Wakeup& wakeup;
  rt::Outbox& outbox;                          ///< for other threads
  std::vector<std::unique_ptr<LaneTo>> lanes;  ///< by which data goes to them in batches
  rt::LogQueue* log = nullptr;
  Supervisor* supervisor = nullptr;

  /// The way of data to `reader`, made when it is asked for first.
  /// @thread configuration only
  LaneTo& lane_to(ExecutionContext& reader);

  /// So many hooks and operations may nest: what the stack has room for.
  /// @thread configuration only
  void limit_depth(int limit);

  /// The component whose code runs now, nullptr if none does.
  /// @thread any
  Component* running() const {
    const Entrance* const entrance = innermost.load(std::memory_order_relaxed);
    return entrance == nullptr ? nullptr : &entrance->component();
  }

  /// Has `message` delivered by this context's thread, which is woken at once.
  /// @rt nonblocking, no allocation
  /// @thread any
  void post(rt::Message& message);
  void raise(rt::Signal& signal);
  /// The same where more is to follow: the thread is woken when the calling one flushes its outbox.
  void post_soon(rt::Message& message);
  void raise_soon(rt::Signal& signal);

  /// Sends what this thread has for others: what follows may take its time.
  /// @rt nonblocking; a system call for each thread that sleeps
  /// @thread the context's
  void flush();

  /// True if code that runs in `other` may touch what belongs to this context.
  bool shares_thread_with(const ExecutionContext& other) const {
    return &other == this || simulated || !live.load(std::memory_order_acquire);
  }

 private:
  void wake();
  void wake_soon();
};

}  // namespace armature::component
