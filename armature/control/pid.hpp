// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "armature/base/result.hpp"

namespace armature::control {

/// The PID controller of one joint with a saturated output, in velocity form (paper 1, equation 6):
///
///     u[k] = u[k-1] + kp (e[k] - e[k-1]) + ki e[k] + kd (e[k] - 2 e[k-1] + e[k-2])
///
/// saturated to [u_min, u_max]. The saturated value is the next u[k-1], so nothing winds up. The
/// gains are those of one sample: the period is part of `ki` and `kd`.
class Pid {
 public:
  /// Errors are in the unit of the joint, outputs in that of the actuator; gains are output /
  /// error.
  struct Config {
    double kp = 0.0;  ///< >= 0, like all gains: a sign belongs to the joint, not to its controller
    double ki = 0.0;
    double kd = 0.0;
    double u_min = 0.0;  ///< < u_max
    double u_max = 0.0;
    friend bool operator==(const Config&, const Config&) = default;
  };

  /// What is remembered between two samples.
  struct State {
    double output = 0.0;        ///< u[k-1]
    double last_error = 0.0;    ///< e[k-1]
    double error_before = 0.0;  ///< e[k-2]
    bool started = false;       ///< whether the past errors mean anything
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<void> check(const Config& config);
  static base::Result<Pid> make(const Config& config);

  /// Other gains from the next step on; the state stays, and in velocity form the output does not
  /// jump. Nothing changes on an error, which is that of `check`.
  base::Result<void> reconfigure(const Config& config);

  /// One sample. The first one after a start or a reset does not kick: past errors count as equal
  /// to this one.
  /// @param error  reference - measured
  /// @return the output, within [u_min, u_max]; not a number, and the state as it was, if `error`
  ///         is not finite: to hide it here would keep the fault from whoever must stop the joint
  /// @rt nonblocking, no allocation
  /// @thread the owning activity only
  double step(double error) {
    if (!std::isfinite(error)) return std::numeric_limits<double>::quiet_NaN();
    const double last = state_.started ? state_.last_error : error;
    const double before = state_.started ? state_.error_before : error;
    const double wanted = state_.output + config_.kp * (error - last) + config_.ki * error +
                          config_.kd * (error - 2.0 * last + before);
    if (std::isnan(wanted)) return wanted;  // infinite parts of opposite sign
    state_ = {saturated(wanted), error, last, true};
    return state_.output;
  }

  /// Forgets the past; the next output is ki e[0].
  /// @rt nonblocking, no allocation
  void reset() { reset_to(0.0); }

  /// Takes over from whoever wrote `output` last: the next output is output + ki e[0].
  /// @param output  saturated if it has to be; one that is not finite counts as 0
  /// @rt nonblocking, no allocation
  void reset_to(double output) {
    state_ = State{};
    state_.output = saturated(std::isfinite(output) ? output : 0.0);
  }

  const Config& config() const { return config_; }
  const State& state() const { return state_; }

 private:
  explicit Pid(const Config& config) : config_(config) { reset(); }

  double saturated(double output) const { return std::clamp(output, config_.u_min, config_.u_max); }

  Config config_;
  State state_;
};

}  // namespace armature::control
