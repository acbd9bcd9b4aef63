// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "armature/base/result.hpp"

namespace armature::platform {

/// Keeps all CPUs out of deep idle states while it lives: to wake from one takes a CPU up to some
/// hundred microseconds.
class IdleStateHold {
 public:
  /// The error says how to get the permission.
  static base::Result<IdleStateHold> take(const std::string& device = "/dev/cpu_dma_latency");

  IdleStateHold(IdleStateHold&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)) {}
  IdleStateHold& operator=(IdleStateHold&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~IdleStateHold();

 private:
  explicit IdleStateHold(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;  ///< the kernel heeds the request while it is open
};

}  // namespace armature::platform
