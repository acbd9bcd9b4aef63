// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"
#include "armature/control/pid.hpp"

namespace armature::control {

/// Gains of a Pid that are changed while it drives: they become the new ones evenly, in a time.
class GainFade {
 public:
  /// The gains are these, at once.
  /// @rt nonblocking, no allocation
  void be(const Pid::Config& gains) {
    present_ = to_ = gains;
    fading_ = false;
  }
  /// The gains of this sample, on the way to those that are wanted. Other ones than before begin
  /// anew from where they are.
  /// @param fade_time  >= 0; 0: at once
  /// @rt nonblocking, no allocation
  const Pid::Config& step(const Pid::Config& wanted, base::Time now, base::Duration fade_time);

 private:
  static bool same(const Pid::Config& a, const Pid::Config& b) {
    return a.kp == b.kp && a.ki == b.ki && a.kd == b.kd;
  }

  Pid::Config present_;
  Pid::Config from_;
  Pid::Config to_;
  base::Time since_{};
  bool fading_ = false;
};

}  // namespace armature::control
