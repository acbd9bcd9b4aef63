// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/base/time.hpp"
#include "armature/exec/pace.hpp"

namespace armature::exec::internal {

/// Holds simulated time back to a pace of real time, or altogether. Time passes from instant to
/// instant, and all that is due at one is done before the next is reached.
/// @thread the controlling one
class Pacer {
 public:
  /// From `simulated` on, which it is `now` of the machine's clock.
  void set(double rate, base::Time simulated, base::Time now);
  void pause() { paused_ = true; }
  void resume(base::Time simulated, base::Time now);
  /// While paused: one more instant.
  void step() { ++steps_; }

  /// When the machine's clock reaches the moment at which it is `next` in simulated time; the past
  /// if that is now, the end of time while paused.
  base::Time time_of(base::Time next) const;
  /// `next` is reached. Where the machine is far behind it does not hurry to make up for that.
  void arrive(base::Time next, base::Time now);

  Pace pace() const { return {rate_, paused_}; }

 private:
  double rate_ = kAsFastAsPossible;
  bool paused_ = false;
  std::uint64_t steps_ = 0;
  base::Time simulated_{};  ///< what it was in simulated time at `real_`
  base::Time real_{};
};

}  // namespace armature::exec::internal
