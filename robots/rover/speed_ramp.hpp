// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace armature::rover {

/// Of the left and the right side [m/s].
struct Speeds {
  double left = 0.0;
  double right = 0.0;

  double fastest() const { return std::max(std::abs(left), std::abs(right)); }
  bool are_finite() const { return std::isfinite(left) && std::isfinite(right); }
};

/// Both sides lowered by one factor if one is too fast, so that the curve stays.
inline Speeds within(const Speeds& speeds, double most) {
  const double fastest = speeds.fastest();
  if (fastest <= most) return speeds;
  return {speeds.left * most / fastest, speeds.right * most / fastest};
}

/// Follows wanted speeds with a bounded acceleration of each side. Both sides arrive together, so
/// that a stop stays on its curve.
class SpeedRamp {
 public:
  /// @param most  change of the speed that changes more [m/s], >= 0
  /// @rt nonblocking, no allocation
  const Speeds& step(const Speeds& wanted, double most) {
    const Speeds change{wanted.left - now_.left, wanted.right - now_.right};
    const double largest = change.fastest();
    if (largest <= most) {
      now_ = wanted;
    } else {
      now_.left += change.left * most / largest;
      now_.right += change.right * most / largest;
    }
    return now_;
  }
  void rest() { now_ = {}; }
  const Speeds& now() const { return now_; }
  bool at_rest() const { return now_.left == 0.0 && now_.right == 0.0; }

 private:
  Speeds now_;
};

}  // namespace armature::rover
