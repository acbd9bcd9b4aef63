// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/teach/axes_generator_taught.hpp"

#include <cmath>
#include <utility>

#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;
using component::Reason;
using control::PlayRefusal;
using control::TaughtPlayer;

Outcome AxesGeneratorTaught::set_up() {
  if (const Outcome outcome = AxesGeneratorOnline::set_up(); !outcome) return outcome;
  auto made = TaughtPlayer::make({limits().axes, longest_});
  if (!made) return component::refused(made.error());
  player_ = std::move(made.value());
  const Vector longest(player_->capacity() * limits().axes.size());
  for (auto* const each : {&play_, &play_from_here_, &jog_path_}) each->prepare(longest, 1.0);
  longest_changed_.take();
  return component::accepted();
}

Outcome AxesGeneratorTaught::on_start() {
  if (const Outcome outcome = AxesGeneratorOnline::on_start(); !outcome) return outcome;
  if (longest_changed_.take()) return set_up();
  player_->let_go();
  return component::accepted();
}

void AxesGeneratorTaught::on_update() {
  if (!knows_position()) return;
  if (player_->under_way()) return play_on();
  if (led_) return follow_hand();
  AxesGeneratorOnline::on_update();
}

void AxesGeneratorTaught::play_on() {
  player_->step(time() - stepped_at_);
  if (jog_path_.active() && held_.let_go(time())) player_->stop();
  stepped_at_ = time();
  tell_begin();
  write_desired(player_->positions(), player_->velocities(), player_->accelerations());
  tell_progress(player_->progress(), player_->remaining_s());
  for (auto* const each : {&play_, &play_from_here_, &jog_path_}) {
    if (each->active()) each->report(player_->progress());
    if (!player_->under_way() && !player_->possible()) {
      each->fail("a peer's motionLimitUsed allows no speed somewhere on the path");
    }
  }
  if (player_->under_way()) return;
  take_over();
}

/// Once, when the path begins and is timed.
void AxesGeneratorTaught::tell_begin() {
  if (!player_->on_path() || std::exchange(told_, true) || !player_->slowed()) return;
  log_info(
      "the motion is slower than {} times its teaching, where the limits ask it: it takes {} s",
      speed_, player_->remaining_s());
}

/// The axes are where the path left them.
void AxesGeneratorTaught::take_over() {
  const auto answer = trajectory().begin_at(
      {player_->positions(), player_->velocities(), player_->accelerations()});
  player_->let_go();
  if (!answer.accepted()) refuse_measured(answer.axis);
}

void AxesGeneratorTaught::follow_hand() {
  stepped_at_ = time();
  const auto measured = measured_.read();
  if (const auto wrong = hold_at(measured.value)) return refuse_measured(*wrong);
  tell_progress(1.0, 0.0);
  write_desired(trajectory().positions(), trajectory().velocities(), trajectory().accelerations());
}

Outcome AxesGeneratorTaught::may_begin() {
  if (is_playing()) return component::refused("a taught motion is under way: cancel it first");
  return may_take_axes();
}

bool AxesGeneratorTaught::is_playing(const PlayCommand* but) const {
  const auto plays = [but](const PlayCommand& each) { return &each != but && each.active(); };
  return plays(play_) || plays(play_from_here_) || plays(jog_path_);
}

Outcome AxesGeneratorTaught::may_take_axes() {
  if (led_) {
    Reason why("a hand leads the robot in the mode '");
    return component::refused(why.append(hand_mode_.get()).append("': switch to another mode"));
  }
  if (const Outcome outcome = AxesGeneratorOnline::may_begin(); !outcome) return outcome;
  if (player_->under_way()) take_over();  // it brakes yet, and goes over to what begins
  return component::accepted();
}

Outcome AxesGeneratorTaught::begin_path(const Vector& points, double speed) {
  if (const Outcome outcome = may_play(play_, points, speed); !outcome) return outcome;
  return begun(player_->play(now(), points, speed, peers_limit()), speed);
}

Outcome AxesGeneratorTaught::play_from_here(const PlayCommand& command, const Vector& points,
                                            double speed) {
  if (player_->under_way() && !is_playing(&command)) {
    return component::refused("the axes still brake: wait until they rest");
  }
  if (const Outcome outcome = may_play(command, points, speed); !outcome) return outcome;
  return begun(player_->play_from_here(now(), points, speed, peers_limit()), speed);
}

Outcome AxesGeneratorTaught::begin_jog_path(const Vector& points, double speed) {
  const Outcome outcome = play_from_here(jog_path_, points, speed);
  if (outcome) held_.begin(0, speed, time());
  return outcome;
}

bool AxesGeneratorTaught::keep_jogging_path() {
  return jog_path_.active() && held_.renew(0, held_.velocity(), time());
}

Outcome AxesGeneratorTaught::may_play(const PlayCommand& command, const Vector& points,
                                      double speed) {
  if (is_commanded() || is_playing(&command)) {
    return component::refused("a motion is under way: cancel it first");
  }
  if (const auto answer = player_->check(points, speed); !answer.accepted()) {
    return component::refused(refusal_of(answer));
  }
  if (const Outcome outcome = may_take_axes(); !outcome) return outcome;
  step_to_now();
  return component::accepted();
}

Outcome AxesGeneratorTaught::begun(const TaughtPlayer::Answer& answer, double speed) {
  if (!answer.accepted()) return component::refused(refusal_of(answer));
  speed_ = speed;
  told_ = false;
  return component::accepted();
}

control::OnlineTrajectory::State AxesGeneratorTaught::now() {
  return {trajectory().positions(), trajectory().velocities(), trajectory().accelerations()};
}

void AxesGeneratorTaught::on_switched(const ModeName& mode) {
  led_.assign(mode.view() == hand_mode_.get());
  if (!led_ || state() != component::State::kRunning) return;
  end_commands("a hand leads the robot");
  settle();
}

void AxesGeneratorTaught::reset_position() {
  if (player_->under_way()) take_over();
  AxesGeneratorOnline::reset_position();
}

void AxesGeneratorTaught::settle() {
  player_->let_go();
  AxesGeneratorOnline::settle();
}

void AxesGeneratorTaught::stop() {
  player_->stop();
  AxesGeneratorOnline::stop();
}

void AxesGeneratorTaught::end_commands(std::string_view why) {
  for (auto* const each : {&play_, &play_from_here_, &jog_path_}) each->fail(why);
  AxesGeneratorOnline::end_commands(why);
}

Reason AxesGeneratorTaught::refusal_of(const TaughtPlayer::Answer& answer) const {
  Reason why;
  if (answer.axis != TaughtPlayer::kNoAxis) {
    append_number(why.append("axis "), static_cast<double>(answer.axis + 1)).append(": ");
  }
  why.append(control::to_text(answer.refusal));
  if (answer.refusal == PlayRefusal::kElsewhere) append_number(why.append(": at "), answer.found);
  if (answer.refusal == PlayRefusal::kOutsideLimits) {
    append_number(why.append(": "), answer.found).append(", expected ");
    append_number(why, limit_of(lower_, answer.axis)).append(" to ");
    append_number(why, limit_of(upper_, answer.axis));
  }
  return why;
}

}  // namespace armature::controllers
