// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace armature::rover {

/// Where a vehicle is by what its sides rolled; slip is not seen.
class Odometry {
 public:
  /// @param track  between the sides [m], > 0
  explicit Odometry(double track) : track_(track) {}

  /// @param left, right  what the sides rolled since the last step [m]
  /// @rt nonblocking, no allocation
  void step(double left, double right) {
    const double turned = (right - left) / track_;
    const double way = 0.5 * (left + right);
    x_ += way * std::cos(heading_ + 0.5 * turned);
    y_ += way * std::sin(heading_ + 0.5 * turned);
    heading_ = std::remainder(heading_ + turned, 2.0 * std::numbers::pi);
  }

  double x() const { return x_; }
  double y() const { return y_; }
  /// [rad], -pi to pi
  double heading() const { return heading_; }

 private:
  double track_;
  double x_ = 0.0;
  double y_ = 0.0;
  double heading_ = 0.0;
};

}  // namespace armature::rover
