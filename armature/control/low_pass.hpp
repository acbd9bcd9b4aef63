// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/result.hpp"

namespace armature::control {

/// A low pass of first order, H(s) = omega / (s + omega), by the backward rule of Euler:
///
///     y[k] = (y[k-1] + omega T x[k]) / (1 + omega T)
class LowPass {
 public:
  /// The cut-off frequency and the sampling period.
  struct Config {
    double omega = 0.0;     ///< [rad/s], > 0
    double period_s = 0.0;  ///< T, > 0
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<LowPass> make(const Config& config);

  /// One sample.
  /// @rt nonblocking, no allocation
  double step(double x) { return y_ += share_ * (x - y_); }
  /// What it would say after an input of `y` forever; 0 at the beginning.
  /// @rt nonblocking, no allocation
  void reset_to(double y) { y_ = y; }
  double value() const { return y_; }

 private:
  explicit LowPass(double share) : share_(share) {}

  double share_;  ///< omega T / (1 + omega T)
  double y_ = 0.0;
};

}  // namespace armature::control
