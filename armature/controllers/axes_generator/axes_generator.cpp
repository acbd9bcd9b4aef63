// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/axes_generator/axes_generator.hpp"

#include <string_view>

#include "armature/control/per_joint.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;
using component::Reason;
using control::Refusal;
using control::Trajectory;

Outcome AxesGeneratorPos::set_up() {
  const auto axes = static_cast<std::size_t>(axes_.get());
  struct Limit {
    const component::Property<Vector>& numbers;
    double Trajectory::Axis::*field;
  };
  const Limit limits[] = {{max_velocity_, &Trajectory::Axis::max_velocity},
                          {max_acceleration_, &Trajectory::Axis::max_acceleration},
                          {lower_, &Trajectory::Axis::lower},
                          {upper_, &Trajectory::Axis::upper}};
  Trajectory::Config config{std::vector<Trajectory::Axis>(axes)};
  for (const auto& [numbers, field] : limits) {
    const auto each = control::per_joint(numbers.name(), numbers.get(), axes);
    if (!each) return component::refused(each.error());
    for (std::size_t i = 0; i < axes; ++i) config.axes[i].*field = each.value()[i];
  }
  auto made = Trajectory::make(config);
  if (!made) return component::refused(made.error());
  trajectory_ = std::move(made.value());
  resize(axes);
  peers_limit_.resize(axes);
  move_to_.prepare(Vector(axes), 0.0);
  changes_.take();
  return component::accepted();
}

Outcome AxesGeneratorPos::on_start() {
  begin_run();
  return changes_.take() ? set_up() : component::accepted();
}

void AxesGeneratorPos::on_update() {
  if (!knows_position()) return;
  trajectory_->step(time() - stepped_at_);
  stepped_at_ = time();
  brake_jog_let_go();
  tell_progress(trajectory_->progress(), trajectory_->remaining_s());
  if (move_to_.active() && trajectory_->under_way()) move_to_.report(trajectory_->progress());
  write_desired(trajectory_->positions(), trajectory_->velocities(), trajectory_->accelerations());
}

std::optional<std::size_t> AxesGeneratorPos::hold_at(const Vector& measured) {
  const auto answer = trajectory_->hold(measured);
  return answer.accepted() ? std::nullopt : std::optional(answer.axis);
}

Outcome AxesGeneratorPos::begin_move(const std::vector<double>& positions, double time_s) {
  if (!knows_position()) return component::refused(control::to_text(Refusal::kNoPosition));
  if (!may_move()) return component::refused(kNotArmed);
  if (jog_.active()) return component::refused(control::to_text(Refusal::kUnderWay));
  const Trajectory::Answer answer =
      trajectory_->move_to(positions, time_s, peers_limit_.where_bound());
  if (!answer.accepted()) return component::refused(refusal_of(answer, positions, time_s));
  stepped_at_ = time();
  return component::accepted();
}

/// Whatever does not depend on where the motion begins.
Outcome AxesGeneratorPos::may_wait(const std::vector<double>& positions, double time_s) const {
  const Trajectory::Answer answer = trajectory_->check_request(positions, time_s);
  return answer.accepted() ? component::accepted()
                           : component::refused(refusal_of(answer, positions, time_s));
}

Outcome AxesGeneratorPos::begin_jog(int axis, double velocity) {
  if (!knows_position()) return component::refused(control::to_text(Refusal::kNoPosition));
  if (!may_move()) return component::refused(kNotArmed);
  if (move_to_.active()) return component::refused(control::to_text(Refusal::kUnderWay));
  if (axis < 1 || axis > axes_) {
    Reason why("axis ");
    append_number(why, axis).append(": expected 1 to ");
    append_number(why, axes_);
    return component::refused(why);
  }
  const Trajectory::Answer answer =
      trajectory_->jog(static_cast<std::size_t>(axis - 1), velocity, peers_limit_.where_bound());
  if (!answer.accepted()) return component::refused(refusal_of_jog(answer, axis, velocity));
  stepped_at_ = time();
  jogging_.begin(axis, velocity, time());
  return component::accepted();
}

bool AxesGeneratorPos::keep_jogging(int axis, double velocity) {
  return jog_.active() && jogging_.renew(axis, velocity, time());
}

void AxesGeneratorPos::brake_jog_let_go() {
  if (jog_.active() && jogging_.let_go(time())) trajectory_->stop();
}

void AxesGeneratorPos::reset_position() {
  if (state() != component::State::kRunning || !knows_position()) return;
  begin_anew(trajectory_->stop_from(measured_.read().value, trajectory_->velocities()),
             "resetPosition stopped the motion");
}

void AxesGeneratorPos::settle() {
  constexpr std::string_view kWhy = "the robot was disarmed or armed";
  if (!knows_position()) {
    move_to_.fail(kWhy);
    jog_.fail(kWhy);
    return;
  }
  begin_anew(trajectory_->hold(measured_.read().value), kWhy);
}

/// @param answer  of the trajectory, which begins where the axes are
/// @param why     the motion before ended
void AxesGeneratorPos::begin_anew(const Trajectory::Answer& answer, std::string_view why) {
  stepped_at_ = time();
  move_to_.fail(why);
  jog_.fail(why);
  if (!answer.accepted()) refuse_measured(answer.axis);
}

void AxesGeneratorPos::stop() {
  trajectory_->stop();
  move_to_.fail("stopped");
  jog_.fail("stopped");
}

Reason AxesGeneratorPos::refusal_of(const Trajectory::Answer& answer,
                                    const std::vector<double>& positions, double time_s) const {
  Reason why;
  if (answer.axis != Trajectory::kNoAxis) {
    why.append("axis ");
    append_number(why, static_cast<double>(answer.axis + 1)).append(": ");
  }
  why.append(control::to_text(answer.refusal));
  switch (answer.refusal) {
    case Refusal::kWrongNumber:
      why.append(": expected ");
      append_number(why, axes_).append(", found ");
      append_number(why, static_cast<double>(positions.size()));
      break;
    case Refusal::kOutsideLimits:
      why.append(": ");
      append_number(why, positions[answer.axis]).append(", expected ");
      append_number(why, limit_of(lower_, answer.axis)).append(" to ");
      append_number(why, limit_of(upper_, answer.axis));
      break;
    case Refusal::kNotFinite:
      why.append(answer.axis == Trajectory::kNoAxis ? ": the time is " : ": ");
      append_number(why, answer.axis == Trajectory::kNoAxis ? time_s : positions[answer.axis]);
      break;
    case Refusal::kTooFast:
      why.append(": it takes ");
      append_number(why, answer.shortest_s).append(" s at least, found ");
      append_number(why, time_s).append(" s (0 asks for the shortest)");
      break;
    case Refusal::kNegativeTime:
      why.append(": ");
      append_number(why, time_s);
      break;
    default:
      break;
  }
  return why;
}

Reason AxesGeneratorPos::refusal_of_jog(const Trajectory::Answer& answer, int axis,
                                        double velocity) const {
  Reason why;
  if (answer.axis != Trajectory::kNoAxis) {
    why.append("axis ");
    append_number(why, axis).append(": ");
  }
  why.append(control::to_text(answer.refusal));
  if (answer.refusal == Refusal::kNotFinite || answer.refusal == Refusal::kTooFast) {
    append_number(why.append(": "), velocity);
  }
  if (answer.refusal == Refusal::kTooFast) {
    append_number(why.append(" ").append(units_.velocity().get()).append(", expected at most "),
                  answer.fastest)
        .append(" ")
        .append(units_.velocity().get());
  }
  return why;
}

}  // namespace armature::controllers
