// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <unordered_map>

namespace armature::exec::internal {

/// Where threads wait, set up and with their priorities, until all components have started.
class StartGate {
 public:
  /// True if the threads may go, false if the start was given up.
  /// @param thread  the number of the one that waits
  /// @param runs    what it runs: its ExecutionContext
  bool wait(const void* runs, int thread) {
    std::unique_lock lock(mutex_);
    threads_[runs] = thread;
    changed_.wait(lock, [this] { return state_ != State::kClosed; });
    return state_ == State::kOpen;
  }
  void open() { change(State::kOpen); }
  /// Of the thread that runs it; 0 if it never waited here.
  int thread_of(const void* runs) const {
    const std::lock_guard lock(mutex_);
    const auto found = threads_.find(runs);
    return found == threads_.end() ? 0 : found->second;
  }
  /// Threads that still wait go home.
  void give_up() { change(State::kGivenUp); }

 private:
  enum class State { kClosed, kOpen, kGivenUp };

  void change(State state) {
    {
      const std::lock_guard lock(mutex_);
      if (state_ == State::kClosed) state_ = state;
    }
    changed_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::unordered_map<const void*, int> threads_;
  State state_ = State::kClosed;
};

}  // namespace armature::exec::internal
