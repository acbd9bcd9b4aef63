// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/control_cycle/monolithic.hpp"

#include <algorithm>

namespace armature::benchmarks {
namespace {

constexpr double kPeriod = 0.001;  // s

}  // namespace

MonolithicController::MonolithicController(int joints)
    : cards_(make_simulated_cards(joints)),
      pids_(cards_.size()),
      sensor_(2 * cards_.size()),
      act_(cards_.size()) {
  for (int i = 0; i < joints; ++i) {
    joints_.push_back(
        {gear_ratio_of(i), 0.0, false, control::JointLimiter::make(limits_of_joints()).value()});
    joints_.back().limiter.arm({});
    reference_.push_back(reference_of(i));
  }
}

void MonolithicController::cycle() {
  sample();
  control();
  actuate();
  ++cycles_;
}

void MonolithicController::sample() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    const double displacement = joint.ratio * cards_[i]->read(joint.index);
    joint.position += displacement;
    sensor_[i] = joint.position;
    sensor_[joints_.size() + i] = displacement;
  }
}

void MonolithicController::control() {
  for (std::size_t i = 0; i < pids_.size(); ++i) {
    Pid& pid = pids_[i];
    const double error = reference_[i] - sensor_[i];
    const double control = pid.control + pid.kp * (error - pid.last_error) + pid.ki * error +
                           pid.kd * (error - 2.0 * pid.last_error + pid.error_before_last);
    pid.control = std::clamp(control, pid.u_min, pid.u_max);
    pid.error_before_last = pid.last_error;
    pid.last_error = error;
    act_[i] = pid.control;
  }
}

void MonolithicController::actuate() {
  for (std::size_t i = 0; i < cards_.size(); ++i) {
    const control::JointLimiter::Measured measured{sensor_[i],
                                                   sensor_[joints_.size() + i] / kPeriod};
    cards_[i]->drive(joints_[i].limiter.step_effort(measured, act_[i]).value);
  }
}

const SimulatedMotor& MonolithicController::motor(int joint) const {
  return motor_of(*cards_[static_cast<std::size_t>(joint)]);
}

}  // namespace armature::benchmarks
