// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

namespace armature::testing::model {

/// Runs functions, one after another, on a stack of its own.
class Fiber {
 public:
  Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;
  ~Fiber();

  /// The next `resume` calls `task`; the one before must have returned.
  void set_task(std::function<void()> task);
  /// Runs the task until it suspends itself or returns.
  void resume();
  /// Goes back to where `resume` was called. To be called by the task.
  void suspend();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace armature::testing::model
