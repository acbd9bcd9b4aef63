// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "armature/exec/engine.hpp"
#include "armature/platform/thread.hpp"
#include "armature/rt/alarms.hpp"

namespace armature::exec::internal {

/// The thread that wakes triggered threads when data of theirs becomes too old. It sleeps as long
/// as data comes in time, and is as urgent as the most urgent of them.
class AgeWatch {
 public:
  /// Before the engines' loops begin. Throws std::system_error if there is no thread to be had.
  /// @param realtime  whether threads are asked to be real-time ones
  AgeWatch(const std::vector<std::unique_ptr<Engine>>& engines, bool realtime);
  AgeWatch(const AgeWatch&) = delete;
  AgeWatch& operator=(const AgeWatch&) = delete;
  ~AgeWatch();

  /// What was asked for and granted; nothing if no engine needs it.
  const platform::ThreadRequest& request() const { return request_; }
  const platform::ThreadGrant* grant() const { return thread_ ? &thread_->grant() : nullptr; }

 private:
  void serve();

  /// Threads that are given up go on using it.
  std::shared_ptr<rt::Alarms> alarms_ = std::make_shared<rt::Alarms>();
  std::atomic<bool> ending_{false};
  platform::ThreadRequest request_;
  std::optional<platform::Thread> thread_;
};

}  // namespace armature::exec::internal
