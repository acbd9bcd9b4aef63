// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/cartesian/path_planner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/quoted.hpp"
#include "armature/component/checking/check_of_threads.hpp"
#include "armature/controllers/cartesian/pose_arguments.hpp"
#include "armature/rt/guard.hpp"

namespace armature::controllers {

using component::CommandStage;
using component::Outcome;
using control::PosePath;

namespace {

constexpr base::Duration kLongestPlannersPeriod = std::chrono::milliseconds(20);
constexpr std::size_t kFewestJoints = 6;
constexpr double kAtRest = 1e-9;        // rad/s
constexpr double kLongestPath = 100.0;  // m: no arm reaches so far, and planning would take long

double in_thousandths(double number) { return std::round(number * 1e3) / 1e3; }

}  // namespace

void PathPlanner::on_check(component::Check& check) const {
  const char* const kHint = "give it activity: {periodic: 10 ms, scheduler: other}";
  if (period() <= base::Duration::zero() || period() > kLongestPlannersPeriod) {
    check.error("the period must be above 0 and at most 20 ms", kHint);
  }
  const auto* const threads = component::CheckOfThreads::of(check);
  if (threads == nullptr) return;
  if (threads->is_real_time()) {
    check.error("it plans for tens of milliseconds, and its thread is a real-time one", kHint);
    return;
  }
  const auto* const player = check.target_of(play_path_);
  if (player != nullptr && threads->shares_thread_with(player->owner())) {
    check.error("it plans for tens of milliseconds in the thread of the generator " +
                    base::quoted(player->owner().name()),
                "give it a thread of its own");
  }
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
  jog_end_.assign({});
  return component::accepted();
}

/// Commands under way are cancelled before, and those that were sent last may still brake.
void PathPlanner::on_stop() { motion_.cancel(); }

void PathPlanner::on_update() {
  const rt::PermitScope in_a_thread_of_its_own;
  if (line_.active()) follow(line_);
  if (arc_.active()) follow(arc_);
  if (path_.active()) follow(path_);
  if (jog_.active()) follow(jog_);  // the generator lets go of it, and it ends at rest
}

Outcome PathPlanner::begin_line(const Vector& pose, double speed) {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto to = read_pose_of(pose);
  if (!to) return component::refused(to.error());
  const auto begin = begin_at_rest();
  if (!begin) return component::refused(begin.error());
  return play(begin.value(), PosePath::line(arm_->pose_at(begin.value()), to.value()), speed);
}

Outcome PathPlanner::begin_arc(const Vector& via, const Vector& pose, double speed) {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto to = read_pose_of(pose);
  if (!to) return component::refused(to.error());
  if (via.size() != 3) {
    return component::refused("via has " + std::to_string(via.size()) +
                              " numbers, expected three: x y z");
  }
  const auto begin = begin_at_rest();
  if (!begin) return component::refused(begin.error());
  return play(begin.value(),
              PosePath::arc(arm_->pose_at(begin.value()), {via[0], via[1], via[2]}, to.value()),
              speed);
}

Outcome PathPlanner::begin_path(const Vector& poses, double blend, double speed) {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto to = read_poses_of(poses);
  if (!to) return component::refused(to.error());
  const auto begin = begin_at_rest();
  if (!begin) return component::refused(begin.error());
  return play(begin.value(), PosePath::through(arm_->pose_at(begin.value()), to.value(), blend),
              speed);
}

/// One reading for all that is planned: a path begins only where the reference rests.
base::Result<PathPlanner::Vector> PathPlanner::begin_at_rest() {
  if (!motion_.ended()) return base::Error{"a motion is under way: cancel it first"};
  const auto velocity = desired_velocity_.read();
  const auto position = desired_.read();
  if (!velocity || !position) {
    return base::Error{
        "nAxesDesiredPosition or nAxesDesiredVelocity has no new value: the generator runs first"};
  }
  const auto moves = [](double each) { return !(std::abs(each) <= kAtRest); };
  if (std::ranges::any_of(velocity.value, moves)) {
    return base::Error{"the joints move, or brake: wait until they rest"};
  }
  return Vector(position.value);
}

/// Whether the reference has left the place from which a motion was planned meanwhile.
bool PathPlanner::has_left(const Vector& begin) {
  const auto now = begin_at_rest();
  if (!now) return true;
  for (std::size_t i = 0; i < begin.size(); ++i) {
    if (std::abs(now.value()[i] - begin[i]) > kAtRest) return true;
  }
  return false;
}

/// What it plans is the generator's to play: that arms nothing and keeps the joints' limits.
Outcome PathPlanner::play(const Vector& begin, const Path& path, double speed) {
  if (!path) return component::refused(path.error());
  if (!(speed >= 0.0) || speed > velocity_) {
    return component::refused("the speed is " + std::to_string(speed) +
                              " m/s, expected 0 to max_tool_velocity, " +
                              std::to_string(velocity_.get()));
  }
  if (const double length = path.value().length(); !(length <= kLongestPath)) {
    return component::refused("the path is " + std::to_string(length) + " m long, expected up to " +
                              std::to_string(kLongestPath) + " m");
  }
  control::CartesianLimits limits = limits_;
  if (speed > 0.0) limits.velocity = speed;
  const auto plan = control::plan_cartesian(*arm_, path.value(), begin, limits);
  if (!plan) return component::refused(plan.error());
  log_info("{} m in {} s, within {} mm of the path", in_thousandths(path.value().length()),
           in_thousandths(plan.value().duration_s),
           in_thousandths(1000.0 * plan.value().largest_deviation));
  return send(play_path_, begin, plan.value());
}

Outcome PathPlanner::send(Caller& caller, const Vector& begin, const control::CartesianPlan& plan) {
  if (has_left(begin)) return component::refused("the joints moved while the path was planned");
  motion_ = caller.send(plan.points, plan.speed);
  if (motion_.stage() == CommandStage::kRefused) return component::refused(motion_.reason());
  return component::accepted();
}

/// In the axes of the base or of the tool, as far as the joints get.
Outcome PathPlanner::begin_jog(int axis, double velocity) {
  const rt::PermitScope in_a_thread_of_its_own;
  const auto begin = begin_at_rest();
  if (!begin) return component::refused(begin.error());
  const auto frame = read_frame_of(jog_frame_.get());
  if (!frame) return component::refused(frame.error());
  const ToolAxis along{axis, velocity, frame.value()};
  const double most = along.turns() ? turning_.get() : velocity_.get();
  if (std::string wrong = objection_to(along, most); !wrong.empty()) {
    return component::refused(wrong);
  }
  control::CartesianLimits limits = limits_;
  limits.velocity = way_of(along);
  const auto line = line_along(arm_->pose_at(begin.value()), along);
  if (!line) return component::refused(line.error());
  auto jog = control::plan_jog(*arm_, line.value(), begin.value(), limits);
  if (!jog) return component::refused(jog.error());
  if (Outcome outcome = send(jog_path_, begin.value(), jog.value().plan); !outcome) return outcome;
  jogging_.begin(axis, velocity, time());
  jog_end_.assign(component::Reason(jog.value().end.empty() ? longest_text(along)
                                                            : std::string_view(jog.value().end)));
  return component::accepted();
}

/// Told to the generator, which brakes where nobody tells it, whatever this thread does meanwhile.
bool PathPlanner::keep_jogging(int axis, double velocity) {
  if (!jog_.active() || !jogging_.renew(axis, velocity, time())) return false;
  if (motion_.stage() == CommandStage::kQueued) return true;  // it begins as if renewed
  const auto answer = keep_jogging_path_();
  return answer && answer.value;
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
