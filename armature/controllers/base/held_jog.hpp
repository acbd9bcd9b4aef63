// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "armature/base/time.hpp"

namespace armature::controllers {

/// A jog, which goes on while somebody renews it.
/// @rt nonblocking, no allocation
class HeldJog {
 public:
  void begin(int axis, double velocity, base::Time now) { *this = HeldJog(axis, velocity, now); }

  /// The same velocity means the same number: a renewal is for the jog that it was sent for.
  /// @return whether it is for this one, which has not been let go
  bool renew(int axis, double velocity, base::Time now) {
    if (axis != axis_ || velocity != velocity_ || let_go_) return false;
    renewed_at_ = now;
    return true;
  }

  /// @return whether nobody renewed it for 150 ms; from then on it is renewed no more
  bool let_go(base::Time now) {
    let_go_ = let_go_ || now - renewed_at_ >= kPatience;
    return let_go_;
  }

  double velocity() const { return velocity_; }

  HeldJog() = default;

 private:
  HeldJog(int axis, double velocity, base::Time now)
      : axis_(axis), velocity_(velocity), renewed_at_(now) {}

  static constexpr base::Duration kPatience = std::chrono::milliseconds(150);
  int axis_ = 0;
  double velocity_ = 0.0;
  base::Time renewed_at_{};
  bool let_go_ = false;
};

}  // namespace armature::controllers
