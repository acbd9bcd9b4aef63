// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>

namespace armature::exec::internal {

/// Where threads wait, set up and with their priorities, until all components have started.
class StartGate {
 public:
  /// True if the threads may go, false if the start was given up.
  bool wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return state_ != State::kClosed; });
    return state_ == State::kOpen;
  }
  void open() { change(State::kOpen); }
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

  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::kClosed;
};

}  // namespace armature::exec::internal
