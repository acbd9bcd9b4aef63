// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/arm_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::wam {

using controllers::DrivenJoint;
using controllers::figure;
using Wanted = controllers::CheckedGains::Wanted;

namespace {

/// [rad] that a limit may lie beyond a stop: home lies at two of them.
constexpr double kBeyond = 0.07;
/// Of the description's velocities: commands are cut above what motions use.
constexpr double kFaster = 1.25;
constexpr double kRounding = 1.02;
/// Of a joint's weight: what its compensation may be wrong by, and the joint sinks this far [rad].
constexpr double kUnknownWeight = 0.1;
constexpr double kSinking = 0.05;
/// [m/s^2]
constexpr double kSameGravity = 0.3;
/// [s] In which a torque has to grow to the largest: an arm that is taken over from its brakes, or
/// pushed, moves until it is held.
constexpr double kGrowingTime = 0.04;

/// `name` of a joint is wrong: `found`, and what was expected.
struct Bound {
  const char* name;
  double found;
  const char* unit;
  const char* whose;
  double expected;
};

std::string text_of(const Bound& bound) {
  return std::string(bound.name) + " is " + figure(bound.found) + " " + bound.unit + ", " +
         bound.whose + " " + figure(bound.expected) + " " + bound.unit;
}

}  // namespace

ArmCheck::ArmCheck(component::Component* owner, const component::Property<int>& joints,
                   const component::Property<std::string>& bus,
                   const controllers::RobotDescription& description, WamParameters& parameters)
    : Checked(owner),
      owner_(*owner),
      joints_(joints),
      bus_(bus),
      description_(description),
      parameters_(parameters),
      other_mounting_(owner, "other_mounting", false,
                      "the arm's base leans or hangs, and gravity says how; else it stands") {
  parameters.add_follower(*this);
}

const ArmNumbers& ArmCheck::numbers() const { return joints_ == 4 ? wam4() : wam7(); }

void ArmCheck::check(component::Check& check) const {
  arm_.reset();
  if (joints_ != 4 && joints_ != 7) return;  // The configuration says so.
  auto arm = load();
  if (!arm) return check.error(arm.error());
  arm_ = std::move(arm).value();
  if (const std::string wrong = objection_to_gravity(); !wrong.empty()) check.error(wrong);
  if (const std::string wrong = objection({}); !wrong.empty()) check.error(wrong);
}

base::Result<ArmCheck::Arm> ArmCheck::load() const {
  std::vector<std::string> warnings;
  auto links = description_.load(numbers().joints(), warnings);
  if (!links) return base::Error{links.error()};
  auto motors = control::Transmission::make(numbers().transmission);
  if (!motors) return base::Error{motors.error()};
  const std::size_t joints = numbers().joints();
  Arm arm{.ranges = control::find_joint_ranges(links.value(), &motors.value(),
                                               control::search_limits(links.value())),
          .limits = links.value().limits(),
          .friction = std::vector<double>(joints, 0.0)};
  const std::vector<double> none(joints, 0.0);
  for (std::size_t i = 0; i < joints; ++i) {
    std::vector<double> turning = none, torques = none;
    turning[i] = 1.0;
    motors.value().add_rotor_torques(turning, none, torques);
    arm.friction[i] = torques[i];
  }
  return arm;
}

std::vector<DrivenJoint> ArmCheck::driven() const {
  if (joints_ != 4 && joints_ != 7) return {};
  if (!arm_) {
    auto arm = load();
    if (!arm) return {};
    arm_ = std::move(arm).value();
  }
  return driven(*arm_);
}

std::vector<DrivenJoint> ArmCheck::driven(const Arm& arm) const {
  std::vector<DrivenJoint> joints(arm.ranges.size());
  const auto config = parameters_.torque_path(numbers());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    control::JointPlant plant;
    plant.damping = arm.friction[i];
    plant.delay_s = kTorqueDelay;
    joints[i].name = "joint " + std::to_string(i + 1) + " of " + owner_.name();
    joints[i].lightest = joints[i].heaviest = plant;
    joints[i].lightest.inertia = arm.ranges[i].least_inertia;
    joints[i].heaviest.inertia = arm.ranges[i].most_inertia;
    joints[i].most_effort = config ? config.value().limits[i].max_effort : 0.0;
    if (config) {
      joints[i].lower = config.value().limits[i].lower;
      joints[i].upper = config.value().limits[i].upper;
      joints[i].max_velocity = config.value().limits[i].max_velocity;
      joints[i].max_acceleration = config.value().max_acceleration[i];
    }
    joints[i].most_weight = arm.ranges[i].most_weight;
    joints[i].gravity = description_.gravity();
    const bool commands_hold = config && config.value().command_has_weight;
    joints[i].holds_weight =
        commands_hold ? controllers::HoldsWeight::kCommands : controllers::HoldsWeight::kHardware;
  }
  return joints;
}

std::string ArmCheck::objection_to(const component::PropertyBase& property,
                                   const types::Value& value) const {
  if (!arm_) return {};
  if (parameters_.says_who_holds_the_weight(property) &&
      value.text() != types::to_text(property.type(), property.data())) {
    return "controllers were checked for the weight that it leaves to them; set it in the "
           "deployment, which is checked again";
  }
  return objection({.property = &property, .data = value.data()});
}

std::string ArmCheck::objection(const Wanted& wanted) const {
  const auto config = parameters_.torque_path(numbers(), wanted);
  if (!config) return config.error();
  for (std::size_t i = 0; i < numbers().joints(); ++i) {
    std::string wrong = objection_to_limits(config.value(), i);
    if (wrong.empty()) wrong = objection_to_hold(config.value(), i);
    if (wrong.empty()) wrong = objection_to_growth(config.value(), i);
    if (!wrong.empty()) return "joint " + std::to_string(i + 1) + ": " + wrong;
  }
  return {};
}

std::string ArmCheck::objection_to_limits(const TorquePath::Config& config,
                                          std::size_t joint) const {
  const control::JointLimiter::Config& limits = config.limits[joint];
  const control::JointLimits& described = arm_->limits[joint];
  const control::JointRange& range = arm_->ranges[joint];
  const double most = config.max_torque[joint];
  const double acceleration = config.max_acceleration[joint];
  for (const Bound& bound :
       {Bound{"PositionMax", limits.upper, "rad", "the joint ends at", described.upper + kBeyond},
        Bound{"minus PositionMin", -limits.lower, "rad", "the joint ends at",
              kBeyond - described.lower},
        Bound{"MaxVelocity", limits.max_velocity, "rad/s", "the arm allows",
              kFaster * described.max_velocity},
        Bound{"MaxTorque", most, "Nm", "its motors give", kRounding * described.max_effort},
        Bound{"MaxControlTorque", limits.max_effort, "Nm", "MaxTorque", most},
        Bound{"MaxTorqueGrowth", config.max_growth[joint], "Nm",
              "expected at most half of MaxTorque,", 0.5 * most},
        Bound{"its weight", range.most_weight, "Nm", "MaxTorque", most},
        Bound{"the torque of MaxAcceleration and its weight",
              range.most_inertia * acceleration + range.most_weight, "Nm", "MaxTorque", most}}) {
    const bool within = bound.found <= bound.expected;  // nothing that is no number is
    if (!within) return text_of(bound);
  }
  const bool possible = limits.lower < limits.upper && limits.max_velocity > 0.0 && most > 0.0 &&
                        limits.max_effort > 0.0 && acceleration > 0.0 &&
                        config.max_growth[joint] > 0.0;
  return possible ? "" : "a limit is not above 0, or PositionMin not below PositionMax";
}

std::string ArmCheck::objection_to_growth(const TorquePath::Config& config,
                                          std::size_t joint) const {
  const double most = config.max_torque[joint];
  const double growth = config.max_growth[joint];
  const double least = most * base::to_seconds(owner_.period()) / kGrowingTime;
  if (growth >= std::min(least, 0.5 * most)) return {};
  return "MaxTorqueGrowth is " + figure(growth) + " Nm in a period, expected at least " +
         figure(least) + ", so that MaxTorque of " + figure(most) + " Nm is there within " +
         figure(1e3 * kGrowingTime) + " ms: the arm moves until it is held";
}

std::string ArmCheck::objection_to_hold(const TorquePath::Config& config, std::size_t joint) const {
  const JointGains& gains = config.hold[joint];
  const double period = base::to_seconds(owner_.period());
  const double unknown = kUnknownWeight * arm_->ranges[joint].most_weight;
  if (!(gains.kp * kSinking >= unknown)) {
    return "Kp is " + figure(gains.kp) + " Nm/rad, expected at least " +
           figure(unknown / kSinking) + ", so that it holds a tenth of its weight within " +
           figure(kSinking) + " rad";
  }
  if (!(gains.max_torque > unknown)) {
    return "MaxOwnTorque is " + figure(gains.max_torque) +
           " Nm, expected above a tenth of its weight, " + figure(unknown) + " Nm";
  }
  if (period <= 0.0) return {};
  const auto controller = control::SampledController::of(control::PositionalPid::Config{
      .kp = gains.kp, .ki = gains.ki, .kd = gains.kd, .period_s = period});
  const DrivenJoint driven_joint = driven(*arm_)[joint];
  const std::string wrong = controllers::objection_to_gains(driven_joint, controller, period);
  if (wrong.empty()) return {};
  return "Kp " + figure(gains.kp) + ", Ki " + figure(gains.ki) + ", Kd " + figure(gains.kd) +
         ", with which it is held: " + wrong.substr(driven_joint.name.size() + 2);
}

std::string ArmCheck::objection_to_gravity() const {
  const auto& [x, y, z] = description_.gravity();
  const bool emulated = bus_.get() == "emulator" || bus_.get().starts_with("virtual:");
  const std::string found = "gravity is [" + figure(x) + ", " + figure(y) + ", " + figure(z) +
                            "] m/s^2, expected [0, 0, " + figure(-kGravity) + "]";
  if (std::hypot(x, y, z) == 0.0) return found + ": the arm holds its weight itself";
  const bool stands = std::hypot(x, y, z + kGravity) <= kSameGravity;
  if (stands) return {};
  if (emulated) return found + ": the emulated arm stands upright";
  return other_mounting_ ? "" : found + ", or other_mounting: true if the base leans or hangs";
}

}  // namespace armature::wam
