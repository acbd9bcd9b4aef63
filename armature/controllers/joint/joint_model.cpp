// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/joint_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "armature/base/joined.hpp"
#include "armature/component/interface.hpp"

namespace armature::controllers {

using control::JointLimits;

namespace {

/// [rad] that a limit may lie beyond the description's: a joint may rest at its stop.
constexpr double kBeyond = 0.07;
/// Of the description's velocity: commands are cut above what motions use.
constexpr double kFaster = 1.25;
constexpr double kRoundedFigures = 1.02;
/// Of a gear that two properties tell.
constexpr double kSameGear = 0.005;

std::string versus(const std::string& what, double found, const std::string& unit,
                   const std::string& whose, double expected) {
  return what + " is " + figure(found) + " " + unit + ", " + whose + " " + figure(expected) + " " +
         unit;
}

bool all_numbers(const JointSettings& limits) {
  return !std::isnan(limits.lower) && !std::isnan(limits.upper) &&
         !std::isnan(limits.max_velocity) && !std::isnan(limits.max_acceleration) &&
         !std::isnan(limits.max_effort) && !std::isnan(limits.max_error) &&
         !std::isnan(limits.gear_ratio);
}

const component::InputPortBase* input_of(const component::Component& joint, std::string_view name) {
  const auto& inputs = component::interface_of(joint).inputs;
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [name](const auto* each) { return each->name() == name; });
  return found == inputs.end() ? nullptr : *found;
}

}  // namespace

const JointHardware* hardware_of(const component::Component& joint, const component::Check& check) {
  for (const std::string_view name : {"DisplacementSensor", "PositionSensor"}) {
    for (const component::OutputPortBase* const writer : check.writers_of(*input_of(joint, name))) {
      const auto* const hardware = dynamic_cast<const JointHardware*>(&writer->owner());
      if (hardware != nullptr) return hardware;
    }
  }
  return nullptr;
}

JointModel::JointModel(component::Component* owner, JointProperties& settings, JointCommand command)
    : Checked(owner),
      owner_(*owner),
      settings_(settings),
      command_(command),
      number_(owner, "RobotJoint", 0, "which joint of the Robot it is, from 1", "",
              component::range(0, 100000)) {
  settings.add_follower(*this);
}

/// Those among which the joint could be: its peer alone, if that is one.
std::vector<const component::Component*> JointModel::robots(const component::Check& check) const {
  const auto describes = [](const component::Component* one) {
    return dynamic_cast<const DescribesRobot*>(one) != nullptr;
  };
  for (const component::Component* const peer : check.peers()) {
    if (describes(peer)) return {peer};
  }
  std::vector<const component::Component*> all;
  if (number_ != 0) std::ranges::copy_if(check.components(), std::back_inserter(all), describes);
  return all;
}

const DescribesRobot* JointModel::robot(const component::Check& check) const {
  const auto all = robots(check);
  return all.size() == 1 ? dynamic_cast<const DescribesRobot*>(all.front()) : nullptr;
}

void JointModel::refuse_robots(component::Check& check) const {
  const auto all = robots(check);
  const std::string needed = "RobotJoint needs exactly one component of the model Robot, found ";
  if (all.empty()) {
    return check.error(needed + "none",
                       "add one, or leave out RobotJoint; in a replay of some components alone, "
                       "let the Robot run again, too");
  }
  std::vector<std::string> names;
  for (const auto* const one : all) names.push_back(one->name());
  check.error(needed + base::joined(names),
              "make the one that it is of a peer: peers: [" + names.front() + "]");
}

void JointModel::check(component::Check& check) const {
  known_.reset();
  const JointSettings& limits = settings_.get();
  check_ends(check);
  check_sensor(check);
  if (!all_numbers(limits)) return check.error("one of its limits is not a number");
  const DescribesRobot* const model = robot(check);
  if (number_ == 0 && model == nullptr) {
    return check.warning(
        "its limits and the gains of its controller are not checked against the robot: what it "
        "moves and what its drive gives are not declared",
        "add a component of the model Robot, and set RobotJoint to the number of this joint in it");
  }
  if (model == nullptr) return refuse_robots(check);
  auto found = find(*model);
  if (!found) return check.error(found.error());
  if (const JointHardware* const told = hardware_of(owner_, check)) {
    found.value().sensor_turns = told->sensor_turns();
    found.value().of_shaft = told->tells_of_shaft();
  }
  if (const std::string wrong = objection(found.value(), limits); !wrong.empty()) {
    check.error(wrong);
  }
  known_ = std::move(found).value();
}

/// A joint either has both ends, or none.
void JointModel::check_ends(component::Check& check) const {
  for (const component::PropertyBase* const each : component::interface_of(owner_).properties) {
    if (each->name() != "PositionMin" && each->name() != "PositionMax") continue;
    const std::string name = "property '" + std::string(each->name()) + "'";
    if (settings_->continuous && each->was_set()) {
      check.error(name + " is given, and Continuous says that the joint turns without end",
                  "leave out one of them");
    } else if (!settings_->continuous && !each->was_set()) {
      check.error(name + " has no default and must be given",
                  "or set Continuous: true for a joint that turns without end");
    }
  }
}

/// One sensor tells; a drive that is told where to go has to say where it is.
void JointModel::check_sensor(component::Check& check) const {
  const bool turned = !check.writers_of(*input_of(owner_, "DisplacementSensor")).empty();
  const bool placed = !check.writers_of(*input_of(owner_, "PositionSensor")).empty();
  if (turned && placed) {
    check.error("both DisplacementSensor and PositionSensor have a writer",
                "connect the one that its hardware has");
  } else if (turned && command_ == JointCommand::kPosition) {
    check.error("its drive is told where to go, so PositionSensor has to say where it is",
                "connect PositionSensor; with DisplacementSensor alone command velocities");
  } else if (!turned && !placed) {
    check.error("neither DisplacementSensor nor PositionSensor has a writer",
                "connect the one that its hardware has");
  }
}

std::optional<DrivenJoint> JointModel::driven(const component::Check& check) const {
  if (!is_effort(command_)) return std::nullopt;
  if (!known_ && number_ != 0) {
    const DescribesRobot* const model = robot(check);
    if (model == nullptr) return std::nullopt;
    auto found = find(*model);
    if (found) known_ = std::move(found).value();
  }
  return known_ ? std::optional(known_->joint) : std::nullopt;
}

base::Result<JointModel::Known> JointModel::find(const DescribesRobot& robot) const {
  if (number_ == 0) {
    return base::Error{"RobotJoint is 0: set it to the number of this joint in the Robot, from 1"};
  }
  const auto number = static_cast<std::size_t>(number_.get());
  auto joint = robot.joint(number, command_);
  if (!joint) return base::Error{joint.error()};
  Known known{.joint = std::move(joint).value(), .described = {}};
  known.joint.name = owner_.name();
  known.joint.unit = settings_.units().position().get();
  known.joint.most_effort = settings_->max_effort;
  known.joint.lower = settings_->lowest();
  known.joint.upper = settings_->highest();
  known.joint.max_velocity = settings_->max_velocity;
  known.joint.max_acceleration = settings_->max_acceleration;
  known.described = robot.limits(number);
  return known;
}

std::string JointModel::objection(const Known& known, const JointSettings& limits) const {
  std::string wrong = objection_to_motion(known.described, limits, known.joint.unit);
  if (wrong.empty() && is_effort(command_)) wrong = objection_to_effort(known, limits);
  return wrong.empty() ? objection_to_gear(known, limits.gear_ratio) : wrong;
}

std::string JointModel::objection_to_motion(const JointLimits& described,
                                            const JointSettings& limits, const std::string& unit) {
  if (described.slides && *described.slides != (unit == "m")) {
    return "Unit is '" + unit + "', and in the description the joint " +
           (*described.slides ? "slides: expected 'm'" : "turns: expected 'rad'");
  }
  if (limits.lowest() < described.lower - kBeyond) {
    return versus(limits.continuous ? "Continuous: PositionMin" : "PositionMin", limits.lowest(),
                  unit, "the joint ends at", described.lower);
  }
  if (limits.highest() > described.upper + kBeyond) {
    return versus(limits.continuous ? "Continuous: PositionMax" : "PositionMax", limits.highest(),
                  unit, "the joint ends at", described.upper);
  }
  if (limits.max_velocity > kFaster * described.max_velocity) {
    return versus("MaxVelocity", limits.max_velocity, unit + "/s", "the description allows",
                  described.max_velocity);
  }
  return {};
}

std::string JointModel::objection_to_effort(const Known& known, const JointSettings& limits) const {
  const std::string torques = unit_for("Nm", known.joint.unit);
  const std::string limit(names_of(command_).limit);
  const double torque = known.joint.lightest.torque_per_effort * limits.max_effort;
  const double braking =
      known.joint.heaviest.inertia * limits.max_acceleration + known.joint.most_weight;
  if (torque > kRoundedFigures * known.described.max_effort) {
    return versus(limit + " " + figure(limits.max_effort) + ": its torque", torque, torques,
                  "the description allows", known.described.max_effort);
  }
  if (known.joint.most_weight > torque) {
    return versus(limit + " " + figure(limits.max_effort) + ": its torque", torque, torques,
                  "the joint weighs up to", known.joint.most_weight);
  }
  if (braking > kRoundedFigures * torque) {
    return versus("MaxAcceleration " + figure(limits.max_acceleration) + " " + known.joint.unit +
                      "/s^2: its torque",
                  braking, torques, limit + " gives", torque);
  }
  return {};
}

/// What a joint takes for its position is what its drive moves: a sensor tells of the motor's axis.
std::string JointModel::objection_to_gear(const Known& known, double gear_ratio) {
  const bool is_told = known.joint.motor_turns != 0.0;
  if (!is_told && known.of_shaft && std::abs(gear_ratio - 1.0) > kSameGear) {
    return "GearRatio is " + figure(gear_ratio) +
           ", expected 1: its hardware tells of the shaft behind its own gear. If there is "
           "another gear behind, tell it as motor_gear_ratio of the Robot";
  }
  const double turns = known.joint.motor_turns;
  const double told = turns * known.sensor_turns;
  if (!is_told || std::abs(gear_ratio * told - 1.0) <= kSameGear) return {};
  const std::string of_sensor =
      known.sensor_turns == 1.0
          ? "is of the motor's axis"
          : "has a gear of " + figure(1.0 / known.sensor_turns) + " taken into account";
  return "GearRatio is " + figure(gear_ratio) + ", expected " + figure(1.0 / told) +
         ": the Robot's motor_gear_ratio says " + figure(turns) +
         " turns of the motor for one of the joint, and DisplacementSensor " + of_sensor;
}

std::string JointModel::objection_to(const component::PropertyBase& property,
                                     const types::Value& value) const {
  if (!known_) return {};
  const JointSettings wanted = settings_.with(&property, value.data());
  if (!all_numbers(wanted)) return "it is not a number";
  return objection(*known_, wanted);
}

}  // namespace armature::controllers
