// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/robot/joint_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "armature/base/as_reason.hpp"
#include "armature/base/diagnostic.hpp"
#include "armature/base/quoted.hpp"
#include "armature/cli/robot/figures.hpp"
#include "armature/control/dynamics/joint_inertias.hpp"
#include "armature/control/sampled_loop.hpp"

namespace armature::cli {
namespace {

using control::JointLimits;
using control::JointRange;

constexpr double kFastestPole = 20.0;  // rad/s
constexpr double kSlowestPole = 4.0;
constexpr double kLeastShare = 0.1;        // of the heaviest pose: its damping ratio is then 0.3
constexpr double kVelocityCutoff = 180.0;  // rad/s, the default of ControllerGravityPD
constexpr double kUsualVelocity = 2.0;     // rad/s
constexpr double kMostAcceleration = 8.0;  // rad/s^2
constexpr double kLeastAcceleration = 0.05;
constexpr double kMostMotionVelocity = 1.0;
constexpr double kMostMotionAcceleration = 2.0;
constexpr double kMotionShare = 0.7;  // of the limiter's: a command that is cut is felt as a jerk
constexpr double kTorqueShare = 0.9;
constexpr double kFirstMotion = 0.5;  // rad

std::string in_kg(double inertia) { return figures_of(inertia) + " kg m^2"; }

bool has_margin(const JointRange& joint, double kp, double kd, const JointDrive& drive) {
  const auto controller = control::SampledController::of(control::SampledController::FilteredPd{
      .kp = kp, .kd = kd, .cutoff = kVelocityCutoff, .period_s = drive.period_s});
  for (const double inertia : {joint.least_inertia, joint.most_inertia}) {
    const control::JointPlant plant{.inertia = inertia, .delay_s = drive.delay_s};
    if (!control::judge_loop(plant, controller, drive.period_s).has_margin()) return false;
  }
  return true;
}

/// The poles of I s^2 + kd s + kp at -w, twice. A joint that is much lighter in other poses needs
/// an I between: in the heaviest pose the joint then swings a little.
bool place_poles(const JointRange& joint, const JointDrive& drive, JointPlan& plan) {
  for (double share = 1.0; share > kLeastShare; share *= 0.7) {
    for (double w = kFastestPole; w >= kSlowestPole; w *= 0.95) {
      plan.kp = rounded(w * w * share * joint.most_inertia);
      plan.kd = rounded(2.0 * w * share * joint.most_inertia);
      if (has_margin(joint, plan.kp, plan.kd, drive)) return true;
    }
  }
  return false;
}

void choose_positions(const JointLimits& limits, JointPlan& plan) {
  plan.continuous = !std::isfinite(limits.lower) || !std::isfinite(limits.upper);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  plan.lower = plan.continuous ? rounded_down(-kTurn) : limits.lower;
  plan.upper = plan.continuous ? -plan.lower : limits.upper;
  const bool zero_inside = plan.lower < 0.0 && plan.upper > 0.0;
  plan.start = zero_inside ? 0.0 : rounded((plan.lower + plan.upper) / 2.0);
  const double above = plan.upper - plan.start;
  const double below = plan.start - plan.lower;
  const double way = std::min(kFirstMotion, rounded_down(0.5 * std::max(above, below)));
  plan.target = plan.start + (above >= below ? way : -way);
}

/// A limit of 0 in a description stands for one that nobody looked up.
double told(double limit, double otherwise) {
  return std::isfinite(limit) && limit > 0.0 ? limit : otherwise;
}

std::string choose_limits(const JointLimits& limits, const JointRange& joint, JointPlan& plan) {
  if (limits.slides == true) {
    return "slides, and what is written here is for joints that turn; begin with a robot that has "
           "none, and add a joint with 'Unit: m'";
  }
  choose_positions(limits, plan);
  if (!(plan.upper > plan.lower)) return "has no room between its limits";
  if (limits.max_velocity <= 0.0) return "has the velocity limit 0; write what it can do";
  if (limits.max_effort <= 0.0) return "has the effort limit 0; write what its drive can do [Nm]";
  plan.max_velocity = told(limits.max_velocity, kUsualVelocity);
  const double needed = joint.most_weight + kMostAcceleration * joint.most_inertia;
  plan.max_torque = told(limits.max_effort, rounded(2.0 * needed));
  const double left = plan.max_torque - joint.most_weight;
  plan.max_acceleration =
      std::min(kMostAcceleration, rounded_down(kTorqueShare * left / joint.most_inertia));
  if (plan.max_acceleration < kLeastAcceleration) {
    return "weighs up to " + figures_of(joint.most_weight) + " Nm and moves up to " +
           in_kg(joint.most_inertia) + ", but its effort limit is " + figures_of(plan.max_torque) +
           " Nm; mend its masses or its limit";
  }
  plan.motion_velocity =
      std::min(kMostMotionVelocity, rounded_down(kMotionShare * plan.max_velocity));
  plan.motion_acceleration =
      std::min(kMostMotionAcceleration, rounded_down(kMotionShare * plan.max_acceleration));
  return {};
}

std::string plan_joint(const JointLimits& limits, const JointRange& joint, const JointDrive& drive,
                       JointPlan& plan) {
  if (std::string wrong = choose_limits(limits, joint, plan); !wrong.empty()) return wrong;
  if (!drive.closed_here || place_poles(joint, drive, plan)) return {};
  return "moves " + in_kg(joint.least_inertia) + " to " + in_kg(joint.most_inertia) +
         ", for which no gains have a margin; mend its inertias";
}

std::string in_words(std::size_t joints) {
  return std::to_string(joints) + (joints == 1 ? " joint" : " joints");
}

}  // namespace

base::Result<std::vector<JointPlan>> plan_joints(const std::string& urdf, const std::string& file,
                                                 std::size_t joints, const JointDrive& drive) {
  base::Diagnostics diagnostics;
  auto links = control::InverseDynamics::parse(urdf, file, {}, diagnostics);
  if (!links) return base::Error{base::as_reason(diagnostics)};
  if (links->joints() != joints) {
    return base::Error{base::quoted(file) + " has " + in_words(links->joints()) +
                       " that move, expected " + std::to_string(joints) + "; give --joints " +
                       std::to_string(links->joints()) + ", or another file"};
  }
  auto ranges = control::find_joint_ranges(*links, nullptr, control::search_limits(*links));
  for (JointRange& joint : ranges) {
    joint.least_inertia += drive.rotor_inertia;
    joint.most_inertia += drive.rotor_inertia;
  }
  std::vector<JointPlan> plans(joints);
  for (std::size_t i = 0; i < joints; ++i) {
    const std::string wrong = plan_joint(links->limits()[i], ranges[i], drive, plans[i]);
    if (wrong.empty()) continue;
    return base::Error{base::quoted(file) + ": joint " + base::quoted(links->joint_names()[i]) +
                       " " + wrong};
  }
  return plans;
}

}  // namespace armature::cli
