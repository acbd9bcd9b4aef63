// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "armature/platform/futex.hpp"

namespace armature::benchmarks {

/// The bare futex hop from one thread to another: what a hand-over cannot do without.
class Baton {
 public:
  void pass() {
    if (word_.exchange(1) == 0) platform::futex_wake_one(word_);
  }
  /// Sleeps until it is passed; several passes before that count as one.
  void wait() {
    while (word_.exchange(0) == 0) platform::futex_wait(word_, 0);
  }

 private:
  std::atomic<std::uint32_t> word_{0};
};

}  // namespace armature::benchmarks
