// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sched.h>

#include "benchmarks/check.hpp"

namespace armature::benchmarks {

/// This thread, and the threads and processes that it starts, run on one CPU; as before when the
/// scope ends.
class OnCpu {
 public:
  explicit OnCpu(int cpu) {
    check(sched_getaffinity(0, sizeof before_, &before_) == 0, "sched_getaffinity");
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(cpu), &one);
    check(sched_setaffinity(0, sizeof one, &one) == 0, "sched_setaffinity");
  }
  OnCpu(const OnCpu&) = delete;
  OnCpu& operator=(const OnCpu&) = delete;
  ~OnCpu() { sched_setaffinity(0, sizeof before_, &before_); }

 private:
  cpu_set_t before_;
};

}  // namespace armature::benchmarks
