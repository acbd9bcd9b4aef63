// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::platform {

/// Scheduling policies of the system: SCHED_OTHER, SCHED_FIFO, SCHED_DEADLINE.
enum class Scheduler { kOther, kFifo, kDeadline };

/// What a thread asks of the operating system.
struct ThreadRequest {
  std::string name;  ///< the system shows its first 15 letters
  Scheduler scheduler = Scheduler::kOther;
  int priority = 0;          ///< 1..99 for kFifo, 99 most urgent
  std::vector<int> cpus{};   ///< allowed CPUs; empty: all
  base::Duration runtime{};  ///< kDeadline: budget in each period
  base::Duration period{};   ///< kDeadline
  std::size_t stack_bytes = 512 * 1024;
  bool prefault = true;  ///< touch the whole stack before the body runs
};

/// What the thread got of what it asked for.
struct ThreadGrant {
  Scheduler scheduler = Scheduler::kOther;
  int priority = 0;
  std::vector<int> cpus;
  std::vector<std::string> refusals;  ///< what was refused, why, and how to get it

  bool complete() const { return refusals.empty(); }
};

/// A thread that applies its request to itself before it runs `body`, so that `grant()` is known
/// when the constructor returns. Joins in its destructor.
class Thread {
 public:
  Thread(const ThreadRequest& request, std::function<void()> body);
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;
  ~Thread();

  const ThreadGrant& grant() const;
  void join();
  /// Waits at most `limit` for the body to end; false if it still runs.
  bool join_within(base::Duration limit);
  /// Gives up on a thread that does not end: it keeps what it captured and is never joined.
  void abandon();

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// From now on the calling thread runs only while nobody else wants its CPU, except for a fraction
/// of a percent. It must hold nothing that others wait for. False if the system refuses.
bool run_when_idle();

/// Touches the stack below the caller so that no page fault happens there later.
void prefault_stack(std::size_t bytes);

}  // namespace armature::platform
