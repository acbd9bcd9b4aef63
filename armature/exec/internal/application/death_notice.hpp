// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include "armature/component/context.hpp"

namespace armature::exec::internal {

/// That a thread of the process has died, from whoever noticed to the controlling thread.
class DeathNotice {
 public:
  struct Death {
    const void* workplace;  ///< the ExecutionContext of its components; nullptr: it runs none
    std::string reason;
  };

  /// @thread any, once
  void send(const void* workplace, std::string reason) {
    death_ = {workplace, std::move(reason)};
    sent_.store(true, std::memory_order_release);
  }
  /// Whether it was sent for this thread and not taken yet.
  bool is_about(const component::ExecutionContext& thread) const {
    return sent_.load(std::memory_order_acquire) && death_.workplace == &thread;
  }
  /// Once for what was sent.
  std::optional<Death> take() {
    if (!sent_.exchange(false, std::memory_order_acquire)) return std::nullopt;
    return death_;
  }

 private:
  std::atomic<bool> sent_{false};  ///< of whom and why:
  Death death_{};
};

}  // namespace armature::exec::internal
