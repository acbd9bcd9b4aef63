// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/axis.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"
#include "drives/cia402/emulated_arm.hpp"

namespace armature::cia402 {

void Axis::step(double torque_Nm, base::Duration by) {
  const double dt = base::to_seconds(by);
  torque_ = std::clamp(torque_Nm, -config_.most_torque, config_.most_torque);
  if (config_.arm != nullptr) return config_.arm->push(config_.joint, torque_);
  // Friction is solved for implicitly: it stops the axis and never turns it round.
  const double driven = velocity_ + torque_ / config_.inertia * dt;
  const double damped = driven / (1.0 + config_.viscous / config_.inertia * dt);
  const double stopped_by = config_.friction / config_.inertia * dt;
  velocity_ = std::copysign(std::max(0.0, std::abs(damped) - stopped_by), damped);
  position_ += velocity_ * dt;
}

void Axis::hold() {
  velocity_ = 0.0;
  torque_ = 0.0;
  if (config_.arm != nullptr) config_.arm->hold(config_.joint);
}

double Axis::position() const {
  return config_.arm != nullptr ? config_.arm->position(config_.joint) : position_;
}

double Axis::velocity() const {
  return config_.arm != nullptr ? config_.arm->velocity(config_.joint) : velocity_;
}

void Profile::step_to_velocity(Demand& demand, double target, base::Duration by) const {
  const double dt = base::to_seconds(by);
  const double change = acceleration * dt;
  demand.velocity += std::clamp(target - demand.velocity, -change, change);
  demand.position += demand.velocity * dt;
}

void Profile::step_to_position(Demand& demand, double target, base::Duration by) const {
  const double dt = base::to_seconds(by);
  const double change = acceleration * dt;
  const double distance = target - demand.position;
  if (std::abs(distance) <= change * dt && std::abs(demand.velocity) <= 2.0 * change) {
    demand = {target, 0.0};
    return;
  }
  // The velocity from which it can still stop at the target, half a step ahead.
  const double stoppable =
      -0.5 * change + std::sqrt(0.25 * change * change + 2.0 * acceleration * std::abs(distance));
  const double wanted = std::copysign(std::min(velocity, stoppable), distance);
  step_to_velocity(demand, wanted, by);
}

double AxisLoops::follow_velocity(double velocity, const Axis& axis, base::Duration by) {
  const double inertia = axis.config().inertia;
  const double error = velocity - axis.velocity();
  const double most = axis.config().most_torque;
  integral_ = std::clamp(integral_ + config_.integral_gain * inertia * error * base::to_seconds(by),
                         -most, most);
  return config_.velocity_gain * inertia * error + integral_;
}

double AxisLoops::follow_position(const Demand& demand, const Axis& axis, base::Duration by) {
  const double error = demand.position - axis.position();
  return follow_velocity(demand.velocity + config_.position_gain * error, axis, by);
}

}  // namespace armature::cia402
