// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/gain_fade.hpp"

#include <chrono>
#include <cmath>

namespace armature::control {
namespace {

using Seconds = std::chrono::duration<double>;

}  // namespace

const Pid::Config& GainFade::step(const Pid::Config& wanted, base::Time now,
                                  base::Duration fade_time) {
  if (same(present_, wanted)) {
    be(wanted);
    return present_;
  }
  if (!fading_ || !same(to_, wanted)) {
    from_ = present_;
    since_ = now;
    fading_ = true;
  }
  to_ = wanted;
  const base::Duration passed = now - since_;
  if (passed >= fade_time) {
    be(wanted);
    return present_;
  }
  const double share = Seconds(passed) / Seconds(fade_time);
  present_ = wanted;
  present_.kp = std::lerp(from_.kp, wanted.kp, share);
  present_.ki = std::lerp(from_.ki, wanted.ki, share);
  present_.kd = std::lerp(from_.kd, wanted.kd, share);
  return present_;
}

}  // namespace armature::control
