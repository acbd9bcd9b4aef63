// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/controller_npid_ff/controller_npid_ff.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "armature/component/face.hpp"
#include "armature/control/per_joint.hpp"

namespace armature::controllers {

using component::Outcome;
using control::DcMotor;

Outcome ControllerNPIDFF::on_configure() {
  if (Outcome outcome = set_up_motors(); !outcome) return outcome;
  desired_.assign(3 * joints(), 0.0);
  torques_.assign(joints(), 0.0);
  signals_.assign(joints(), 0.0);
  return ControllerOfPids::on_configure();
}

Outcome ControllerNPIDFF::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up_motors(); !outcome) return outcome;
  }
  return ControllerOfPids::on_start();
}

Outcome ControllerNPIDFF::set_up_motors() {
  auto made = make_motors({});
  if (!made) return component::refused(made.error());
  motors_ = std::move(made).value();
  changes_.take();
  return component::accepted();
}

base::Result<std::vector<DcMotor>> ControllerNPIDFF::make_motors(
    const CheckedGains::Wanted& wanted) const {
  std::vector<DcMotor::Config> configs(joints());
  struct Parameter {
    const Numbers& numbers;
    double DcMotor::Config::*field;
  };
  const Parameter parameters[] = {{resistance_, &DcMotor::Config::resistance_ohm},
                                  {torque_constant_, &DcMotor::Config::torque_constant},
                                  {gear_ratio_, &DcMotor::Config::gear_ratio},
                                  {rotor_inertia_, &DcMotor::Config::rotor_inertia},
                                  {viscous_friction_, &DcMotor::Config::viscous_friction},
                                  {coulomb_friction_, &DcMotor::Config::coulomb_friction},
                                  {coulomb_velocity_, &DcMotor::Config::coulomb_velocity}};
  for (const auto& [numbers, field] : parameters) {
    const auto each = control::per_joint(numbers.name(), wanted.value_of(numbers), joints());
    if (!each) return base::Error{each.error()};
    for (std::size_t i = 0; i < joints(); ++i) configs[i].*field = each.value()[i];
  }
  std::vector<DcMotor> motors;
  for (std::size_t i = 0; i < joints(); ++i) {
    const auto made = DcMotor::make(configs[i]);
    if (!made) return base::Error{"joint " + std::to_string(i + 1) + ": " + made.error()};
    motors.push_back(made.value());
  }
  return motors;
}

/// Feed-forward for other motors than those of the robot would drive it away from what is desired.
std::string ControllerNPIDFF::objection(const std::vector<DrivenJoint>& joints,
                                        const CheckedGains::Wanted& wanted) const {
  constexpr double kAlike = 1.5;
  const auto motors = make_motors(wanted);
  if (!motors) return motors.error();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const DcMotor& motor = motors.value()[i];
    const control::JointPlant& plant = joints[i].heaviest;
    const double per_torque = motor.voltage(1.0, 0.0);
    const double expected = 1.0 / plant.torque_per_effort;
    if (!(per_torque <= kAlike * expected && expected <= kAlike * per_torque)) {
      return joints[i].name + ": feed-forward gives " + figure(per_torque) +
             " V for 1 Nm at the joint, its drive needs " + figure(expected) + " V";
    }
    const double braking = motor.config().viscous_friction +
                           motor.config().torque_constant * motor.config().gear_ratio / per_torque;
    if (!(braking <= kAlike * plant.damping && plant.damping <= kAlike * braking)) {
      return joints[i].name + ": feed-forward is for friction and back-EMF of " + figure(braking) +
             " Nm s/rad, its drive has " + figure(plant.damping);
    }
    if (!(motor.reflected_inertia() <= kAlike * plant.inertia)) {
      return joints[i].name + ": feed-forward is for a rotor of " +
             figure(motor.reflected_inertia()) + " kg m^2 at the joint, the joint moves " +
             figure(plant.inertia) + " in all";
    }
    const double most = plant.torque_per_effort * joints[i].most_effort;
    if (!(motor.config().coulomb_friction <= 0.5 * most)) {
      return joints[i].name + ": coulomb_friction is " + figure(motor.config().coulomb_friction) +
             " Nm, its drive gives " + figure(most) + " Nm";
    }
  }
  return {};
}

/// A model without gravity leaves the weight to the PIDs.
std::optional<std::array<double, 3>> ControllerNPIDFF::gravity_held(
    const component::Check& check) const {
  for (const component::OutputPortBase* const writer : check.writers_of(out_model_)) {
    const auto* const model = dynamic_cast<const ComputesTorques*>(&writer->owner());
    if (model != nullptr && model->gravity() != std::array<double, 3>{}) return model->gravity();
  }
  return std::nullopt;
}

std::string_view ControllerNPIDFF::name_of_other(std::size_t /*member*/) const {
  return writer_of(face(out_model_));
}

void ControllerNPIDFF::ask_others(const std::vector<double>& reference) {
  desired_ = reference;
  in_model_.write(desired_);
}

void ControllerNPIDFF::on_torques(const std::vector<double>& torques) {
  torques_ = torques;
  answer(joints(), 0.0);
}

void ControllerNPIDFF::conclude(const std::vector<double>& answers) {
  const double* const velocities = desired_.data() + joints();
  const double* const accelerations = velocities + joints();
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const double torque = torques_[i] + motors_[i].reflected_inertia() * accelerations[i];
    signals_[i] = answers[i] + motors_[i].voltage(torque, velocities[i]);
  }
  drive(signals_);
}

}  // namespace armature::controllers
