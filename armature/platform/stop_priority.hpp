// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>

#include "armature/base/time.hpp"
#include "armature/platform/stop_signal.hpp"
#include "armature/platform/thread.hpp"

namespace armature::platform {

/// Sees to it that the thread that makes it can stop everything when that is asked for or the time
/// is up, however busy more urgent threads keep the machine: from then on it has SCHED_FIFO 98, or
/// else the best nice value that the system grants. What it does before disturbs nobody.
///
/// The signals are taken by a thread of its own, the most urgent one: the thread that makes it may
/// not run for long enough to take them.
class StopPriority {
 public:
  /// @param stop  outlives it
  /// @param end   when it stops by itself
  StopPriority(const StopSignal& stop, base::Time end);
  StopPriority(const StopPriority&) = delete;
  StopPriority& operator=(const StopPriority&) = delete;
  ~StopPriority();

 private:
  void watch(const StopSignal& stop, base::Time end) const;

  const bool takes_over_;  ///< the signals, from the thread that makes it
  const int stopper_;
  const int interruption_;
  std::unique_ptr<Thread> thread_;
};

/// As long as it lives, its thread and those that are made meanwhile have the best nice value that
/// the system grants: for what an operator asks for. They run before all others without a real-time
/// priority, however many of those are busy, and behind all that have one.
class Promptness {
 public:
  Promptness();
  Promptness(const Promptness&) = delete;
  Promptness& operator=(const Promptness&) = delete;
  ~Promptness();

 private:
  const int before_;
};

/// Gives a thread of this process the best nice value that the system grants; nothing if it has a
/// real-time priority.
/// @param number  as `thread_number` has it; 0: nothing
void make_prompt(int number);

/// Gives a thread of this process SCHED_FIFO 98, or else the best nice value that the system
/// grants.
/// @param number  as `thread_number` has it
void make_most_urgent(int number);

}  // namespace armature::platform
