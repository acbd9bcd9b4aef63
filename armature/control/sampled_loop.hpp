// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/control/pid.hpp"
#include "armature/control/polynomial.hpp"
#include "armature/control/positional_pid.hpp"

namespace armature::control {

/// What the controller of one joint drives: inertia angle'' + damping angle' = torque_per_effort
/// effort(t - delay).
struct JointPlant {
  double inertia = 0.0;            ///< [kg m^2] of links and rotor at the joint, > 0
  double damping = 0.0;            ///< [N m s/rad] of friction and of a motor's back-EMF, >= 0
  double torque_per_effort = 1.0;  ///< [N m] at the joint for one unit of effort, > 0
  double delay_s = 0.0;            ///< from a sample until the effort acts that answers it, >= 0
};

/// A linear controller from the error of a joint to its effort, one step a sample, by its transfer
/// function in z.
class SampledController {
 public:
  static SampledController of(const Pid::Config& gains);
  /// Of the PID; the limits of its integral and its output do not count.
  static SampledController of(const PositionalPid::Config& gains);

  /// A PD controller whose velocity is a difference of two samples behind a control::LowPass.
  struct FilteredPd {
    double kp = 0.0;
    double kd = 0.0;
    double cutoff = 0.0;    ///< [rad/s], > 0; infinite: no filter
    double period_s = 0.0;  ///< > 0
  };
  static SampledController of(const FilteredPd& gains);

  const Polynomial& numerator() const { return numerator_; }
  const Polynomial& denominator() const { return denominator_; }

 private:
  SampledController(Polynomial numerator, Polynomial denominator)
      : numerator_(numerator), denominator_(denominator) {}

  Polynomial numerator_;
  Polynomial denominator_;
};

/// How the sampled loop of one joint behaves.
struct LoopStability {
  /// By how much all gains together may grow until the joint swings on; below 1: it does with these
  /// gains already, and would not with so much of them; 0: it does with any part of them.
  double gain_margin = 0.0;
  /// Down to which part all gains together may fall; 0: to any.
  double least_gain = 0.0;
  double largest_pole = 0.0;  ///< magnitude; above 1: a motion grows
  double damping = 1.0;       ///< ratio of the swinging pole that is damped least; 1: none swings
  double frequency = 0.0;     ///< [rad/s] with which the joint swings at the gain margin
  bool finite = false;        ///< whether gains and plant were numbers

  /// A margin of two in both directions, as safe loops have it, and swings that die away.
  static constexpr double kLeastMargin = 2.0;
  static constexpr double kLeastDamping = 0.02;
  bool has_margin() const {
    return finite && gain_margin >= kLeastMargin && least_gain * kLeastMargin <= 1.0 &&
           damping >= kLeastDamping;
  }
};

/// Judges the loop of a joint, exactly at its samples: the plant with its effort held for a period.
/// @param period_s  > 0
/// @rt nonblocking, no allocation, a millisecond
LoopStability judge_loop(const JointPlant& plant, const SampledController& controller,
                         double period_s);

/// Whether it has a margin, tried with shares of the gains between a half and twice of them.
/// @rt nonblocking, no allocation, some ten microseconds
bool has_margin(const JointPlant& plant, const SampledController& controller, double period_s);

/// What is wrong with a loop that has no margin: its figures, what was expected, and what to do;
/// empty if it has one.
std::string objection_to_loop(const LoopStability& loop);

}  // namespace armature::control
