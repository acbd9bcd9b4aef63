// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/axes_generator/axes_generator_online.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/control/per_joint.hpp"
#include "armature/controllers/base/of_this_run.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {
namespace {

/// As it is told: to a microsecond.
double rounded(double seconds) { return std::round(seconds * 1e6) / 1e6; }

/// In which the acceleration reaches its limit, where nobody says how large the jerk may be [s].
constexpr double kUsualRise_s = 0.1;

}  // namespace

using component::Outcome;
using component::Reason;
using control::OnlineTrajectory;
using control::TargetRefusal;

Outcome AxesGeneratorOnline::set_up() {
  const auto axes = static_cast<std::size_t>(axes_.get());
  struct Limit {
    const component::Property<Vector>& numbers;
    double OnlineTrajectory::Axis::*field;
  };
  const Limit limits[] = {{max_velocity_, &OnlineTrajectory::Axis::max_velocity},
                          {max_acceleration_, &OnlineTrajectory::Axis::max_acceleration},
                          {max_jerk_, &OnlineTrajectory::Axis::max_jerk},
                          {lower_, &OnlineTrajectory::Axis::lower},
                          {upper_, &OnlineTrajectory::Axis::upper}};
  OnlineTrajectory::Config config{std::vector<OnlineTrajectory::Axis>(axes)};
  for (const auto& [numbers, field] : limits) {
    if (field == &OnlineTrajectory::Axis::max_jerk && max_jerk_.get().empty()) {
      for (auto& axis : config.axes) axis.max_jerk = axis.max_acceleration / kUsualRise_s;
      continue;
    }
    const auto each = control::per_joint(numbers.name(), numbers.get(), axes);
    if (!each) return component::refused(each.error());
    for (std::size_t i = 0; i < axes; ++i) config.axes[i].*field = each.value()[i];
  }
  auto made = OnlineTrajectory::make(config);
  if (!made) return component::refused(made.error());
  limits_ = config;
  trajectory_ = std::move(made.value());
  resize(axes);
  peers_limit_.resize(axes);
  move_to_.prepare(Vector(axes), 0.0);
  changes_.take();
  return component::accepted();
}

Outcome AxesGeneratorOnline::on_start() {
  begin_run();
  refused_references_.assign(0);
  return changes_.take() ? set_up() : component::accepted();
}

/// A reference counts before the step: what it says is where the axes are to be now.
void AxesGeneratorOnline::on_update() {
  if (!knows_position()) return;
  step_to_now();
  if (follow_.active()) follow_reference();
  if (jog_.active() && jogging_.let_go(time())) brake();
  tell_progress(trajectory_->progress(), trajectory_->remaining_s());
  if (move_to_.active() && trajectory_->under_way()) move_to_.report(trajectory_->progress());
  write_desired(trajectory_->positions(), trajectory_->velocities(), trajectory_->accelerations());
}

std::optional<std::size_t> AxesGeneratorOnline::hold_at(const Vector& measured) {
  const auto answer = trajectory_->hold(measured);
  return answer.accepted() ? std::nullopt : std::optional(answer.axis);
}

Outcome AxesGeneratorOnline::may_begin() {
  if (!knows_position()) return component::refused(control::to_text(TargetRefusal::kNoPosition));
  return may_move() ? component::accepted() : component::refused(kNotArmed);
}

void AxesGeneratorOnline::step_to_now() {
  trajectory_->step(time() - stepped_at_);
  stepped_at_ = time();
}

/// From where the axes are now, not where they were in the last cycle.
OnlineTrajectory::Answer AxesGeneratorOnline::go_to(const OnlineTrajectory::State& target,
                                                    double time_s) {
  step_to_now();
  return trajectory_->move_to(target, time_s, peers_limit_.where_bound());
}

Outcome AxesGeneratorOnline::begin_move(const Vector& positions, double time_s) {
  if (const Outcome outcome = may_begin(); !outcome) return outcome;
  if (follow_.active()) return component::refused("follow is under way: cancel it first");
  if (jog_.active()) return component::refused("a jog is under way: let go of it first");
  const Answer answer = go_to({positions}, time_s);
  if (!answer.accepted()) return component::refused(refusal_of(answer, positions, time_s));
  return component::accepted();
}

/// Whatever does not depend on where the motion begins.
Outcome AxesGeneratorOnline::may_wait(const Vector& positions, double time_s) const {
  const Answer answer = trajectory_->check_target({positions}, time_s);
  return answer.accepted() ? component::accepted()
                           : component::refused(refusal_of(answer, positions, time_s));
}

Outcome AxesGeneratorOnline::begin_jog(int axis, double velocity) {
  if (const Outcome outcome = may_begin(); !outcome) return outcome;
  if (move_to_.active()) return component::refused("moveTo is under way: cancel it first");
  if (follow_.active()) return component::refused("follow is under way: cancel it first");
  if (axis < 1 || axis > axes_) {
    Reason why("axis ");
    append_number(append_number(why, axis).append(": expected 1 to "), axes_);
    return component::refused(why);
  }
  step_to_now();
  const Answer answer =
      trajectory_->jog(static_cast<std::size_t>(axis - 1), velocity, peers_limit_.where_bound());
  if (!answer.accepted()) return component::refused(refusal_of_jog(answer, axis, velocity));
  jogging_.begin(axis, velocity, time());
  return component::accepted();
}

bool AxesGeneratorOnline::keep_jogging(int axis, double velocity) {
  return jog_.active() && jogging_.renew(axis, velocity, time());
}

bool AxesGeneratorOnline::change_target(const Vector& positions) {
  return move_to_.active() && may_move() && go_to({positions}, 0.0).accepted();
}

Outcome AxesGeneratorOnline::begin_follow() {
  if (const Outcome outcome = may_begin(); !outcome) return outcome;
  if (move_to_.active()) return component::refused("moveTo is under way: cancel it first");
  if (jog_.active()) return component::refused("a jog is under way: let go of it first");
  const auto reference = reference_.read();
  if (!reference || !is_of_this_run(reference, started_)) {
    return component::refused("nAxesReferencePosition has no new value: its writer must run first");
  }
  return component::accepted();
}

void AxesGeneratorOnline::follow_reference() {
  const auto reference = reference_.read();
  const auto velocity = reference_velocity_.read();
  const bool with_velocity = velocity.status != component::ReadStatus::kNotConnected;
  if (!reference || (with_velocity && !velocity)) {
    brake();
    follow_.fail("the references are too old: their writer fell silent");
    return;
  }
  OnlineTrajectory::State target{reference.value};
  if (with_velocity) target.velocities = velocity.value;
  // A target in motion is where the axes are to be when it comes, not in each cycle after it.
  if (with_velocity && !reference.is_new()) return;
  if (!trajectory_->move_to(target, 0.0, peers_limit_.where_bound()).accepted() &&
      reference.is_new()) {
    refused_references_.assign(refused_references_ + 1);
  }
}

void AxesGeneratorOnline::reset_position() {
  if (state() != component::State::kRunning || !knows_position()) return;
  const Answer answer = trajectory_->begin_at(
      {measured_.read().value, trajectory_->velocities(), trajectory_->accelerations()});
  stepped_at_ = time();
  end_commands("resetPosition stopped the motion");
  if (!answer.accepted()) refuse_measured(answer.axis);
}

void AxesGeneratorOnline::settle() {
  end_commands("the robot was disarmed or armed");
  if (!knows_position()) return;
  const Answer answer = trajectory_->hold(measured_.read().value);
  stepped_at_ = time();
  if (!answer.accepted()) refuse_measured(answer.axis);
}

void AxesGeneratorOnline::stop() {
  brake();
  end_commands("stopped");
}

void AxesGeneratorOnline::end_commands(std::string_view why) {
  move_to_.fail(why);
  follow_.fail(why);
  jog_.fail(why);
}

Reason AxesGeneratorOnline::refusal_of(const Answer& answer, const Vector& positions,
                                       double time_s) const {
  Reason why;
  if (answer.axis != OnlineTrajectory::kNoAxis) {
    append_number(why.append("axis "), static_cast<double>(answer.axis + 1)).append(": ");
  }
  why.append(control::to_text(answer.refusal));
  switch (answer.refusal) {
    case TargetRefusal::kWrongNumber:
      append_number(why.append(": expected "), axes_).append(", found ");
      append_number(why, static_cast<double>(positions.size()));
      break;
    case TargetRefusal::kOutsideLimits:
      append_number(why.append(": "), positions[answer.axis]).append(", expected ");
      append_number(why, limit_of(lower_, answer.axis)).append(" to ");
      append_number(why, limit_of(upper_, answer.axis));
      break;
    case TargetRefusal::kNotFinite:
      why.append(answer.axis == OnlineTrajectory::kNoAxis ? ": the time is " : ": ");
      append_number(why,
                    answer.axis == OnlineTrajectory::kNoAxis ? time_s : positions[answer.axis]);
      break;
    case TargetRefusal::kTooFast:
      append_number(why.append(": it takes "), rounded(answer.shortest_s))
          .append(" s at least, found ");
      append_number(why, time_s).append(" s (0 asks for the shortest)");
      break;
    case TargetRefusal::kNegativeTime:
      append_number(why.append(": "), time_s);
      break;
    default:
      break;
  }
  return why;
}

Reason AxesGeneratorOnline::refusal_of_jog(const Answer& answer, int axis, double velocity) const {
  Reason why;
  if (answer.axis != OnlineTrajectory::kNoAxis)
    append_number(why.append("axis "), axis).append(": ");
  why.append(control::to_text(answer.refusal));
  const bool too_fast = answer.refusal == TargetRefusal::kTooFast;
  if (too_fast || answer.refusal == TargetRefusal::kNotFinite) {
    append_number(why.append(": "), velocity);
  }
  if (too_fast)
    append_number(why.append(" ").append(units_.velocity().get()).append(", expected at most "),
                  answer.fastest)
        .append(" ")
        .append(units_.velocity().get());
  return why;
}

}  // namespace armature::controllers
