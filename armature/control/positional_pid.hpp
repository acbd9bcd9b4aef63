// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "armature/base/result.hpp"

namespace armature::control {

/// The PID controller of one joint in positional form, as the Barrett WAM's own software has it:
///
///     i[k] = i[k-1] + ki T e[k-1]                    within +-max_integral, if that is above 0
///     u[k] = kp e[k] + i[k] + kd (e[k] - e[k-1]) / T   within +-max_output, if that is above 0
///
/// Unlike `Pid`, it has gains per second, sums without regard to a saturated output, and begins
/// with a past error of 0: a first error that is not small kicks.
class PositionalPid {
 public:
  /// Outputs are in the unit of the actuator, errors in that of the joint.
  struct Config {
    double kp = 0.0;            ///< [output / error], >= 0 as all gains
    double ki = 0.0;            ///< [output / (error s)]
    double kd = 0.0;            ///< [output s / error]
    double max_integral = 0.0;  ///< [output]; 0: none
    double max_output = 0.0;    ///< [output]; 0: none
    double period_s = 0.0;      ///< T, > 0
  };

  /// What is remembered between two samples.
  struct State {
    double integral = 0.0;  ///< i[k-1]
    double last_error = 0.0;
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<PositionalPid> make(const Config& config);

  /// One sample.
  /// @param error  reference - measured
  /// @return the output; not a number, and the state as it was, if `error` is not finite
  /// @rt nonblocking, no allocation
  /// @thread the owning activity only
  double step(double error) { return step(error, (error - state_.last_error) / config_.period_s); }
  /// The same where somebody knows how fast the error changes, instead of e[k] - e[k-1].
  /// @param change  of the error [1/s]
  double step(double error, double change) {
    if (!std::isfinite(error) || !std::isfinite(change)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double summed = state_.integral + config_.ki * config_.period_s * state_.last_error;
    state_ = {limited(summed, config_.max_integral), error};
    return limited(config_.kp * error + state_.integral + config_.kd * change, config_.max_output);
  }

  /// Forgets the past.
  /// @rt nonblocking, no allocation
  void reset() { state_ = State{}; }
  /// The same, as if `error` had been there before: a next one that is equal does not kick.
  /// @rt nonblocking, no allocation
  void reset_to(double error) { state_ = {0.0, std::isfinite(error) ? error : 0.0}; }

  const Config& config() const { return config_; }
  const State& state() const { return state_; }

 private:
  explicit PositionalPid(const Config& config) : config_(config) {}

  static double limited(double value, double limit) {
    return limit > 0.0 ? std::clamp(value, -limit, limit) : value;
  }

  Config config_;
  State state_;
};

}  // namespace armature::control
