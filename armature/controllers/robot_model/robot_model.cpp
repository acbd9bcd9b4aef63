// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/robot_model/robot_model.hpp"

#include <cmath>
#include <utility>

#include "armature/control/per_joint.hpp"

namespace armature::controllers {

using control::JointLimits;
using control::JointRange;

/// A motor that is driven with a voltage brakes itself: with k^2 ratio^2 / R, as its torque for a
/// volt is k ratio / R.
base::Result<DrivenJoint> RobotModel::joint(std::size_t number, JointCommand command) const {
  const base::Result<Robot>& found = robot();
  if (!found) return base::Error{found.error()};
  if (number < 1 || number > joints()) {
    return base::Error{name() + " has joints 1 to " + std::to_string(joints()) + ", found " +
                       std::to_string(number)};
  }
  DrivenJoint joint = found.value().joints[number - 1];
  const Motor& motor = found.value().motors[number - 1];
  double torque_per_effort = 1.0;
  double back_emf = 0.0;
  if (command == JointCommand::kCurrent) {
    if (motor.torque_per_ampere == 0.0) {
      return base::Error{name() + " needs motor_torque_constant: joint " + std::to_string(number) +
                         " is given currents"};
    }
    torque_per_effort = motor.torque_per_ampere;
  } else if (command == JointCommand::kVoltage && motor.resistance > 0.0) {
    torque_per_effort = motor.torque_per_ampere / motor.resistance;
    back_emf = torque_per_effort * motor.torque_per_ampere;
  } else if (command == JointCommand::kVoltage && motor.torque_per_ampere > 0.0) {
    return base::Error{name() + " needs motor_resistance: joint " + std::to_string(number) +
                       " is given voltages"};
  }
  for (control::JointPlant* plant : {&joint.lightest, &joint.heaviest}) {
    plant->damping += back_emf;
    plant->torque_per_effort = torque_per_effort;
  }
  return joint;
}

JointLimits RobotModel::limits(std::size_t number) const {
  const base::Result<Robot>& found = robot();
  const bool known = found && number >= 1 && number <= found.value().limits.size();
  return known ? found.value().limits[number - 1] : JointLimits{};
}

void RobotModel::on_check(component::Check& check) const {
  if (const auto& found = robot(); !found) check.error(found.error());
}

const base::Result<RobotModel::Robot>& RobotModel::robot() const {
  const bool changed = changes_.take();
  if (description_.take_change() || changed || !robot_) robot_ = make();
  return *robot_;
}

base::Result<RobotModel::Robot> RobotModel::make() const {
  Robot robot;
  robot.joints.resize(joints());
  const auto found = ranges(robot);
  if (!found) return base::Error{found.error()};
  for (std::size_t i = 0; i < joints(); ++i) {
    DrivenJoint& joint = robot.joints[i];
    joint.name = "joint " + std::to_string(i + 1) + " of " + name();
    joint.lightest.inertia = found.value()[i].least_inertia;
    joint.heaviest.inertia = found.value()[i].most_inertia;
    joint.most_weight = found.value()[i].most_weight;
    joint.gravity = description_.gravity();
  }
  if (const auto added = add_drives(robot); !added) return base::Error{added.error()};
  return robot;
}

base::Result<std::vector<JointRange>> RobotModel::ranges(Robot& robot) const {
  if (!description_.file().empty()) {
    std::vector<std::string> warnings;
    auto links = description_.load(joints(), warnings);
    if (!links) return base::Error{links.error()};
    robot.limits = links.value().limits();
    return control::find_joint_ranges(links.value(), nullptr,
                                      control::search_limits(links.value()));
  }
  if (inertia_min_.get().empty() || inertia_max_.get().empty()) {
    return base::Error{
        "expected robot_description, or inertia_min and inertia_max of what each joint moves"};
  }
  std::vector<JointRange> ranges(joints());
  struct Each {
    const Numbers& numbers;
    double JointRange::*field;
  };
  for (const auto& [numbers, field] :
       {Each{inertia_min_, &JointRange::least_inertia},
        Each{inertia_max_, &JointRange::most_inertia}, Each{weight_, &JointRange::most_weight}}) {
    const auto each = control::per_joint(numbers.name(), numbers.get(), joints());
    if (!each) return base::Error{each.error()};
    for (std::size_t i = 0; i < joints(); ++i) ranges[i].*field = each.value()[i];
  }
  for (const JointRange& each : ranges) {
    const bool possible = each.least_inertia > 0.0 && each.most_inertia >= each.least_inertia &&
                          std::isfinite(each.most_inertia) && each.most_weight >= 0.0;
    if (possible) continue;
    return base::Error{"a joint moves " + figure(each.least_inertia) + " to " +
                       figure(each.most_inertia) + " kg m^2, expected numbers above 0 that grow"};
  }
  return ranges;
}

base::Result<void> RobotModel::add_drives(Robot& robot) const {
  const bool has_resistance = !resistance_.get().empty();
  const bool has_constant = !torque_constant_.get().empty();
  if (has_resistance && !has_constant) {
    return base::Error{"expected motor_torque_constant beside motor_resistance"};
  }
  std::vector<double> resistance, constant, ratio, rotor, friction, delay;
  struct Each {
    const Numbers& numbers;
    std::vector<double>& to;
    double least;
    bool told = true;
  };
  for (const auto& [numbers, to, least, told] :
       {Each{resistance_, resistance, 1e-9, has_resistance},
        Each{torque_constant_, constant, 1e-9, has_constant}, Each{gear_ratio_, ratio, 1e-9},
        Each{rotor_inertia_, rotor, 0.0}, Each{friction_, friction, 0.0},
        Each{delay_, delay, 0.0}}) {
    if (!told) continue;
    auto each = control::per_joint(numbers.name(), numbers.get(), joints());
    if (!each) return base::Error{each.error()};
    for (const double number : each.value()) {
      if (std::isfinite(number) && number >= least) continue;
      return base::Error{std::string(numbers.name()) + " is " + figure(number) +
                         ", expected a finite number " +
                         (least > 0.0 ? "above 0" : "of at least 0")};
    }
    to = std::move(each).value();
  }
  robot.motors.resize(joints());
  for (std::size_t i = 0; i < joints(); ++i) {
    DrivenJoint& joint = robot.joints[i];
    if (has_constant || gear_ratio_.was_set()) joint.motor_turns = ratio[i];
    if (has_constant) robot.motors[i].torque_per_ampere = constant[i] * ratio[i];
    if (has_resistance) robot.motors[i].resistance = resistance[i];
    for (control::JointPlant* plant : {&joint.lightest, &joint.heaviest}) {
      plant->inertia += rotor[i] * ratio[i] * ratio[i];
      plant->damping = friction[i];
      plant->delay_s = delay[i];
    }
  }
  return {};
}

}  // namespace armature::controllers
