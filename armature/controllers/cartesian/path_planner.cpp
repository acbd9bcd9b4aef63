// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/cartesian/path_planner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/rt/guard.hpp"

namespace armature::controllers {

using component::CommandStage;
using component::Outcome;
using control::Pose;
using control::PosePath;

namespace {

constexpr base::Duration kLongestPlannersPeriod = std::chrono::milliseconds(20);
constexpr std::size_t kNumbersOfAPose = 6;
constexpr std::size_t kFewestJoints = 6;

double rounded(double number) { return std::round(number * 1e3) / 1e3; }

base::Result<std::vector<Pose>> read_poses_of(const std::vector<double>& numbers) {
  if (numbers.empty() || numbers.size() % kNumbersOfAPose != 0) {
    return base::Error{"found " + std::to_string(numbers.size()) +
                       " numbers, expected six for each pose: x y z roll pitch yaw"};
  }
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) {
    return base::Error{"a number of the pose is not finite"};
  }
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < numbers.size(); i += kNumbersOfAPose) {
    control::PoseNumbers one;
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i), one.size(), one.begin());
    poses.push_back(control::pose_of(one));
  }
  return poses;
}

base::Result<Pose> read_pose_of(const std::vector<double>& numbers) {
  auto poses = read_poses_of(numbers);
  if (!poses) return base::Error{poses.error()};
  if (poses.value().size() == 1) return poses.value().front();
  return base::Error{"found " + std::to_string(poses.value().size()) + " poses, expected one"};
}

}  // namespace

void PathPlanner::on_check(component::Check& check) const {
  if (period() > base::Duration::zero() && period() <= kLongestPlannersPeriod) return;
  check.error("the period must be above 0 and at most 20 ms",
              "give it activity: {periodic: 10 ms, scheduler: other}");
}

Outcome PathPlanner::on_configure() {
  base::Diagnostics diagnostics;
  auto arm = control::InverseKinematics::load(
      file_, {.base_link = base_link_, .tip_link = tip_link_}, diagnostics);
  if (!arm || !diagnostics.ok()) {
    return component::refused(file_.get() + ": " + base::as_reason(diagnostics));
  }
  const auto joints = static_cast<std::size_t>(joints_.get());
  if (arm->joints() != joints) {
    return component::refused(file_.get() + " moves " + std::to_string(arm->joints()) +
                              " joints up to its tip, expected joints = " + std::to_string(joints));
  }
  if (joints < kFewestJoints) {
    return component::refused(
        "the robot has " + std::to_string(joints) +
        " joints, and a tool that is to be anywhere in any orientation needs six: move its joints");
  }
  arm_ = std::move(arm);
  if (std::string wrong = objection_to_limits(); !wrong.empty()) return component::refused(wrong);
  return component::accepted();
}

/// Its own, or the description's.
std::string PathPlanner::objection_to_limits() {
  const std::size_t joints = arm_->joints();
  limits_ = {.velocity = velocity_,
             .acceleration = acceleration_,
             .turning = turning_,
             .max_deviation = deviation_,
             .lower = lower_,
             .upper = upper_};
  const bool none = limits_.lower.empty() && limits_.upper.empty();
  for (const control::JointLimits& each : arm_->limits()) {
    if (!none) break;
    limits_.lower.push_back(each.lower);
    limits_.upper.push_back(each.upper);
  }
  for (auto* const side : {&limits_.lower, &limits_.upper}) {
    if (side->size() == 1) side->assign(joints, side->front());
    if (side->size() == joints) continue;
    return "lower and upper have " + std::to_string(side->size()) + " numbers, expected " +
           std::to_string(joints) + ", one or none";
  }
  return {};
}

Outcome PathPlanner::on_start() {
  motion_ = component::CommandHandle(component::CallStatus::kNotConnected);
  return component::accepted();
}

void PathPlanner::on_update() {
  const rt::PermitScope in_a_thread_of_its_own;
  if (line_.active()) follow(line_);
  if (arc_.active()) follow(arc_);
  if (path_.active()) follow(path_);
}

Outcome PathPlanner::begin_line(const Vector& pose, double speed) {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto to = read_pose_of(pose);
  if (!to) return component::refused(to.error());
  const auto from = desired_.read();
  if (!from)
    return component::refused("nAxesDesiredPosition has no new value: its writer runs first");
  return play(PosePath::line(arm_->pose_at(from.value), to.value()), speed);
}

Outcome PathPlanner::begin_arc(const Vector& via, const Vector& pose, double speed) {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto to = read_pose_of(pose);
  if (!to) return component::refused(to.error());
  if (via.size() != 3) {
    return component::refused("via has " + std::to_string(via.size()) +
                              " numbers, expected three: x y z");
  }
  const auto from = desired_.read();
  if (!from)
    return component::refused("nAxesDesiredPosition has no new value: its writer runs first");
  return play(PosePath::arc(arm_->pose_at(from.value), {via[0], via[1], via[2]}, to.value()),
              speed);
}

Outcome PathPlanner::begin_path(const Vector& poses, double blend, double speed) {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto to = read_poses_of(poses);
  if (!to) return component::refused(to.error());
  const auto from = desired_.read();
  if (!from)
    return component::refused("nAxesDesiredPosition has no new value: its writer runs first");
  return play(PosePath::through(arm_->pose_at(from.value), to.value(), blend), speed);
}

/// What it plans is the generator's to play: that arms nothing and keeps the joints' limits.
Outcome PathPlanner::play(const Path& path, double speed) {
  const int under_way =
      (line_.active() ? 1 : 0) + (arc_.active() ? 1 : 0) + (path_.active() ? 1 : 0);
  if (under_way > 0 && !motion_.ended()) {
    return component::refused("a motion is under way: cancel it first");
  }
  if (!path) return component::refused(path.error());
  if (!(speed >= 0.0) || speed > velocity_) {
    return component::refused("the speed is " + std::to_string(speed) +
                              " m/s, expected 0 to max_tool_velocity, " +
                              std::to_string(velocity_.get()));
  }
  control::CartesianLimits limits = limits_;
  if (speed > 0.0) limits.velocity = speed;
  const auto plan = control::plan_cartesian(*arm_, path.value(), desired_.read().value, limits);
  if (!plan) return component::refused(plan.error());
  log_info("{} m in {} s, within {} mm of the path", rounded(path.value().length()),
           rounded(plan.value().duration_s), rounded(1000.0 * plan.value().largest_deviation));
  motion_ = play_path_.send(plan.value().points, plan.value().speed);
  if (motion_.stage() == CommandStage::kRefused) return component::refused(motion_.reason());
  return component::accepted();
}

PathPlanner::Vector PathPlanner::pose() {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto desired = desired_.read();
  if (!desired) return {};
  const control::PoseNumbers numbers = control::numbers_of(arm_->pose_at(desired.value));
  return {numbers.begin(), numbers.end()};
}

template <typename Command>
void PathPlanner::follow(Command& command) {
  command.report(motion_.progress());
  if (!motion_.ended()) return;
  if (motion_.stage() == CommandStage::kDone) {
    command.complete();
  } else {
    command.fail(motion_.reason());
  }
}

}  // namespace armature::controllers
