// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"
#include "armature/platform/clock.hpp"

namespace armature::exec::internal {

/// The time of an application: that of the machine, or one that its run loop moves on.
class Clock {
 public:
  /// @param begin  of simulated time
  explicit Clock(bool simulated, base::Time begin = {})
      : simulated_(simulated), simulated_now_(begin) {}

  base::Time now() const { return simulated_ ? simulated_now_ : platform::monotonic_now(); }
  /// Of simulated time only.
  void go_to(base::Time time) { simulated_now_ = time; }

 private:
  const bool simulated_;
  base::Time simulated_now_;
};

}  // namespace armature::exec::internal
