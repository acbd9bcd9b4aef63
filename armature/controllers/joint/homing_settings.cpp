// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/homing_settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/interface.hpp"
#include "armature/controllers/joint/joint_model.hpp"

namespace armature::controllers {

using component::member;
using component::range;
using component::unit_of;

namespace {

using Name = std::pair<std::string_view, HomingMethod>;
constexpr std::array kMethods{Name{"drive", HomingMethod::kDrive},
                              Name{"index", HomingMethod::kIndex},
                              Name{"switch", HomingMethod::kSwitch},
                              Name{"switch_index", HomingMethod::kSwitchThenIndex},
                              Name{"hard_stop", HomingMethod::kHardStop},
                              Name{"here", HomingMethod::kHere}};

/// What but the method it is told.
using Setting = std::pair<std::string_view, double HomingSettings::*>;
constexpr std::array kSettings{Setting{"HomePosition", &HomingSettings::position},
                               Setting{"HomingVelocity", &HomingSettings::velocity},
                               Setting{"HomingTravel", &HomingSettings::travel},
                               Setting{"HomingEffort", &HomingSettings::effort},
                               Setting{"HomingStiffness", &HomingSettings::stiffness},
                               Setting{"HomingDamping", &HomingSettings::damping},
                               Setting{"HomingBackOff", &HomingSettings::back_off}};

/// Of MaxVelocity, for homing: no joint is to look for its end faster.
constexpr double kFastest = 0.5;
/// Of ArmingMotion: shorter ways are not told from standing.
constexpr double kShortestTravel = 4.0;
constexpr double kShortestBackOff = 2.0;
/// Of the way from PositionMin to PositionMax: stops and switches are beyond these.
constexpr double kLongestTravel = 1.5;

}  // namespace

std::optional<HomingMethod> homing_method(std::string_view name) {
  const auto* const found = std::find_if(kMethods.begin(), kMethods.end(),
                                         [name](const Name& each) { return each.first == name; });
  return found == kMethods.end() ? std::nullopt : std::optional(found->second);
}

HomingProperties::HomingProperties(component::Component* owner, JointCommand command,
                                   const JointUnits& units, const JointProperties& joint)
    : Properties(
          owner, {},
          member(
              &HomingSettings::method, "HomingMethod",
              "drive (its hardware homes, if it can), index, switch, switch_index, hard_stop, or "
              "here"),
          member(&HomingSettings::position, "HomePosition",
                 "of the joint at home: at the index, where the switch opens, at the stop, or here",
                 "", unit_of(units.position())),
          member(&HomingSettings::velocity, "HomingVelocity",
                 "with which it looks for home; negative: backwards", "",
                 unit_of(units.velocity())),
          member(&HomingSettings::travel, "HomingTravel", "that it may be away from where it began",
                 "", range(0.0, 1e6), unit_of(units.position())),
          member(&HomingSettings::effort, "HomingEffort",
                 "the most that it is driven with meanwhile; of a drive that follows: at the joint",
                 "", range(0.0, 1e9), unit_of(units.homing_effort())),
          member(&HomingSettings::stiffness, "HomingStiffness",
                 "effort for each unit that it is behind; of a joint that is given efforts", "",
                 range(0.0, 1e9), unit_of(units.stiffness())),
          member(&HomingSettings::damping, "HomingDamping", "the same for its velocity", "",
                 range(0.0, 1e9), unit_of(units.damping())),
          member(&HomingSettings::back_off, "HomingBackOff",
                 "by which it comes away from a hard stop", "", range(1e-6, 1e3),
                 unit_of(units.position()))),
      Checked(owner),
      owner_(*owner),
      command_(command),
      joint_(joint) {}

std::string HomingProperties::objection() const {
  if (!homing_method(get().method)) {
    return "HomingMethod is '" + get().method +
           "', expected drive, index, switch, switch_index, hard_stop or here";
  }
  if (method() == HomingMethod::kDrive) return {};
  if (!std::isfinite(get().position) || get().position < joint_->lowest() ||
      get().position > joint_->highest()) {
    return "HomePosition is " + figure(get().position) +
           ", expected a number from PositionMin to PositionMax";
  }
  if (!moves()) return {};
  if (std::string wrong = objection_to_motion(); !wrong.empty()) return wrong;
  return objection_to_effort();
}

std::string HomingProperties::objection_to_motion() const {
  const double speed = std::abs(get().velocity);
  const double fastest = kFastest * joint_->max_velocity;
  if (!(speed > 0.0 && speed <= fastest)) {
    return "HomingVelocity is " + figure(get().velocity) + ", expected up to " + figure(fastest) +
           ", half of MaxVelocity; negative to look backwards";
  }
  if (!(get().travel > kShortestTravel * joint_->arming_motion)) {
    return "HomingTravel is " + figure(get().travel) + ", expected more than " +
           figure(kShortestTravel * joint_->arming_motion) + ", four times ArmingMotion";
  }
  const double range = joint_->highest() - joint_->lowest();  // infinite if it is continuous
  if (!(get().travel <= kLongestTravel * range)) {
    return "HomingTravel is " + figure(get().travel) + ", expected up to " +
           figure(kLongestTravel * range) + ", 1.5 times the way from PositionMin to PositionMax";
  }
  if (!(joint_->homing_time > get().travel / speed)) {
    return "HomingTime is " + figure(joint_->homing_time) + " s, expected more than " +
           figure(get().travel / speed) + " s, which HomingTravel takes with HomingVelocity";
  }
  if (method() != HomingMethod::kHardStop) return {};
  if (joint_->continuous) {
    return "HomingMethod is hard_stop, and Continuous says that the joint turns without end: leave "
           "out one of them";
  }
  const double shortest = kShortestBackOff * joint_->arming_motion;
  if (!(get().back_off > shortest && get().back_off < get().travel)) {
    return "HomingBackOff is " + figure(get().back_off) + ", expected more than " +
           figure(shortest) + ", twice ArmingMotion, and less than HomingTravel";
  }
  return {};
}

std::string HomingProperties::objection_to_effort() const {
  if (!is_effort(command_)) {
    if (method() != HomingMethod::kHardStop || get().effort > 0.0) return {};
    return "HomingEffort is 0, expected what its drive may push with against the stop";
  }
  if (!(get().effort > 0.0 && get().effort <= joint_->max_effort)) {
    return "HomingEffort is " + figure(get().effort) + ", expected more than 0 and up to " +
           std::string(names_of(command_).limit) + " " + figure(joint_->max_effort);
  }
  if (!(get().stiffness > 0.0)) {
    return "HomingStiffness is 0, expected the effort for each unit by which it is behind";
  }
  return {};
}

/// Settings of a homing that there is not are a mistake in its method. A file that autosave writes
/// has all of them, those too as they are by default.
std::string HomingProperties::objection_to_unused() const {
  const HomingSettings by_default;
  for (const auto& [name, setting] : kSettings) {
    if (get().*setting == by_default.*setting) continue;
    const std::string given = std::string(name) + " is given, and ";
    if (method() == HomingMethod::kDrive) {
      return given + "HomingMethod is 'drive': its hardware homes by its own settings";
    }
    if (setting == &HomingSettings::position) continue;
    if (!moves()) return given + "HomingMethod is 'here': nothing moves";
    const bool is_gain =
        setting == &HomingSettings::stiffness || setting == &HomingSettings::damping;
    if (is_gain && !is_effort(command_)) return given + "its drive follows by its own gains";
    if (setting == &HomingSettings::back_off && method() != HomingMethod::kHardStop) {
      return given + "HomingMethod is '" + get().method + "': it comes away from a hard stop alone";
    }
  }
  return {};
}

/// Samples are what watches it.
std::string HomingProperties::objection_to_no_sampler() const {
  for (const component::PropertyBase* const each : component::interface_of(owner_).properties) {
    if (each->name() != "Sampler" || *static_cast<const bool*>(each->data())) continue;
    return "HomingMethod is " + get().method +
           ", and Sampler is false: nobody would brake the joint if whoever calls sensorRead no "
           "longer did. Set Sampler: true";
  }
  return {};
}

std::string HomingProperties::objection_to(const JointHardware& hardware) const {
  const std::string whose = "HomingMethod is " + get().method + ", and '" + hardware.name() + "' ";
  const JointHardware::HomingSigns signs = hardware.homing_signs();
  if (hardware.sensor() == JointHardware::Sensor::kAbsolute) {
    return whose +
           "knows where it is: use 'here', and write the InitialPos that it prints into the "
           "deployment";
  }
  const bool by_switch =
      method() == HomingMethod::kSwitch || method() == HomingMethod::kSwitchThenIndex;
  const bool by_index =
      method() == HomingMethod::kIndex || method() == HomingMethod::kSwitchThenIndex;
  if (by_switch && !signs.home_switch) {
    return whose +
           "tells of no switch: use another method, or have its homing_signs say so and "
           "its IndexSensor tell of it";
  }
  if (by_index && !signs.index_mark) {
    return whose +
           "tells of no index mark: use another method, or have its homing_signs say so "
           "and its since_index tell of it";
  }
  if (is_effort(command_) || signs.bounds_effort) return {};
  if (method() == HomingMethod::kHardStop) {
    return whose +
           "does not bound the effort of its drive, which would push with all that it "
           "has: use another method, or command it by an effort";
  }
  if (get().effort > 0.0) {
    return "HomingEffort is given, and '" + hardware.name() +
           "' does not bound the effort of its drive: leave it out, bound it in the drive, or "
           "command it by an effort";
  }
  return {};
}

void HomingProperties::check(component::Check& check) const {
  if (const std::string wrong = objection(); !wrong.empty()) return check.error(wrong);
  if (const std::string unused = objection_to_unused(); !unused.empty()) {
    return check.error(unused, "leave it out, or name another method");
  }
  const JointHardware* const hardware = hardware_of(owner_, check);
  is_of_absolute_sensor_ =
      hardware != nullptr && hardware->sensor() == JointHardware::Sensor::kAbsolute;
  const bool counts = hardware != nullptr && hardware->sensor() == JointHardware::Sensor::kCounting;
  if (counts && method() != HomingMethod::kDrive && !joint_->homing_required) {
    check.warning("HomingMethod is " + get().method + ", HomingRequired is not set, and '" +
                      hardware->name() +
                      "' counts from where it was switched on: it can be armed at a position that "
                      "nobody knows",
                  "set HomingRequired: true");
  }
  if (!moves()) return;
  if (const std::string wrong = objection_to_no_sampler(); !wrong.empty()) check.error(wrong);
  if (hardware == nullptr) {
    return check.error("HomingMethod is " + get().method +
                       ", and what its sensor is of does not say what it can be homed by: extend "
                       "JointHardware");
  }
  if (const std::string wrong = objection_to(*hardware); !wrong.empty()) {
    return check.error(wrong);
  }
  if (!is_effort(command_)) return;
  for (const DrivenJoint& joint :
       dynamic_cast<DrivesJoints&>(owner_).joints_behind(nullptr, check)) {
    if (const std::string wrong = objection_to(joint); !wrong.empty()) check.error(wrong);
  }
}

/// As a controller that holds the joint by its gains alone.
std::string HomingProperties::objection_to(const DrivenJoint& joint) const {
  const std::string torques = unit_for("Nm", joint.unit);
  const double torque = joint.lightest.torque_per_effort * get().effort;
  if (torque < joint.most_weight) {
    return "HomingEffort is " + figure(get().effort) + ": its torque is " + figure(torque) + " " +
           torques + ", and the joint weighs up to " + figure(joint.most_weight) + " " + torques;
  }
  const double sag = joint.most_weight / (joint.lightest.torque_per_effort * get().stiffness);
  if (sag > joint_->arming_motion) {
    return "HomingStiffness is " + figure(get().stiffness) + " and lets its weight of " +
           figure(joint.most_weight) + " " + torques + " move it by " + figure(sag) + " " +
           joint.unit + " when its brake opens, expected less than ArmingMotion, " +
           figure(joint_->arming_motion);
  }
  const double period_s = base::to_seconds(owner_.period());
  if (period_s <= 0.0) return {};
  const auto loop = control::SampledController::of(
      control::SampledController::FilteredPd{.kp = get().stiffness,
                                             .kd = get().damping,
                                             .cutoff = std::numeric_limits<double>::infinity(),
                                             .period_s = period_s});
  const std::string wrong = objection_to_gains(joint, loop, period_s);
  return wrong.empty() ? wrong : "HomingStiffness and HomingDamping: " + wrong;
}

}  // namespace armature::controllers
