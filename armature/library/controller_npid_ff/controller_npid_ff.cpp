// SPDX-License-Identifier: Apache-2.0
#include "armature/library/controller_npid_ff/controller_npid_ff.hpp"

#include <algorithm>
#include <string>

#include "armature/control/per_joint.hpp"

namespace armature::library {

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
    const auto each = control::per_joint(numbers.name(), numbers.get(), joints());
    if (!each) return component::refused(each.error());
    for (std::size_t i = 0; i < joints(); ++i) configs[i].*field = each.value()[i];
  }
  motors_.clear();
  for (std::size_t i = 0; i < joints(); ++i) {
    const auto made = DcMotor::make(configs[i]);
    if (!made) return component::refused("joint " + std::to_string(i + 1) + ": " + made.error());
    motors_.push_back(made.value());
  }
  changes_.take();
  return component::accepted();
}

std::string_view ControllerNPIDFF::name_of_other(std::size_t /*member*/) const {
  return writer_of(out_model_);
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

}  // namespace armature::library
