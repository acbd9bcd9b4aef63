// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/wam_hardware.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/rt/guard.hpp"
#include "robots/wam/driver/safety_text.hpp"
#include "robots/wam/tip_speed.hpp"

namespace armature::wam {

using component::CommandStage;
using component::Outcome;

namespace {

/// Cycles in a row without torques, from which on nobody controls the arm any more.
constexpr int kMostWithoutCommand = 3;
/// [rad/s] of all joints together, on the way home.
constexpr double kHomeRate = 0.5;
/// [m/s] of a motion: the board idles the arm at 1 m/s, and what follows overshoots a little.
constexpr double kFastestTip = 0.95;
/// [rad] Nearer each joint lies where it may be let go of.
constexpr double kAtHome = 0.05;
/// In which a motion that was cancelled has come to rest.
constexpr base::Duration kRestTime = std::chrono::seconds(2);

}  // namespace

Outcome WamHardware::on_start() {
  if (positions_lost_) return component::refused(fault_reason(WamFault::kEstop, 0));
  at_home_.withdraw();  // It counts for a configuration that follows; from now on the arm moves.
  held_by_hand_.withdraw();
  link_->begin_run(time());
  driver_->start(link_->now());
  driver_->send_idle();  // A puck may have missed that the board went to idle.
  path_->go_off();
  motion_->forget();
  watch_.begin(parameters_.period().duration());
  followed_ = base::Time::min();
  read_at_ = base::Time::min();
  idle_seen_ = asks_ = commanded_ = false;
  without_command_ = 0;
  out_since_.reset();
  cuts_power_ = false;
  waits_for_.assign({});
  lost_answers_.assign(0);
  cycles_without_command_.assign(0);
  arming_ = arm_.bound() ? &arm_.source()->owner() : nullptr;
  return component::accepted();
}

void WamHardware::on_cleanup() {
  // What was sent last gets on its way.
  const base::Time end = link_->now() + std::chrono::milliseconds(2);
  while (link_->now() < end) link_->wait_for_news(end);
  guard_.end();
  driver_.reset();
  link_->bus().close();
}

// ---- The cycle

bool WamHardware::get_joint_sensors() {
  if (state() != component::State::kRunning) return false;
  on_sample();
  if (state() != component::State::kRunning || !motion_->known()) return false;
  const std::size_t joints = path_->joints();
  std::ranges::copy(motion_->positions(), data_.begin());
  std::ranges::copy(motion_->velocities(), data_.begin() + static_cast<std::ptrdiff_t>(joints));
  std::ranges::copy(path_->joint_torques(),
                    data_.begin() + static_cast<std::ptrdiff_t>(2 * joints));
  joints_data_.write(data_);
  return true;
}

void WamHardware::on_sample() {
  if (read_at_ != time() && is_guarded() && is_in_time()) read_all();
}

/// Out of service if it is sampled otherwise than everything is computed for.
bool WamHardware::is_in_time() {
  if (state() != component::State::kRunning) return true;
  const std::optional<component::Reason> wrong = watch_.sample(*this);
  if (wrong) fault(*wrong);
  return !wrong;
}

void WamHardware::read_all() {
  read_at_ = time();
  link_->begin_cycle(time());
  // The board hears torques in every cycle, also if who commands them is late.
  if (armed() && !commanded_) driver_->send_torques(link_->now());
  const base::Time asked_at = link_->now();
  driver_->begin_reading(asked_at);
  while (driver_->poll(link_->now()) == WamReading::kWaiting) {
    link_->wait_for_news(driver_->deadline());
  }
  motion_->take(*driver_, asked_at);
  path_->measure(motion_->positions(), motion_->velocities());
  count_lost_answers();
  if (!supervise()) return;
  drive_or_hold();
  if (move_home_.active()) follow_home();
}

void WamHardware::count_lost_answers() {
  if (driver_->reading() == WamReading::kComplete) return;
  int lost = 0;
  for (std::size_t i = 0; i < driver_->motors(); ++i) lost += driver_->motor(i).fresh ? 0 : 1;
  lost_answers_.assign(lost_answers_() + lost);
}

/// Armed, torques come later in this cycle.
void WamHardware::drive_or_hold() {
  if (armed()) {
    without_command_ = std::exchange(commanded_, false) ? 0 : without_command_ + 1;
    if (without_command_ > 0) cycles_without_command_.assign(cycles_without_command_() + 1);
    if (without_command_ >= kMostWithoutCommand) disarm("no torques come any more");
    if (arming_ != nullptr && arming_->state() == component::State::kException) {
      disarm("who armed it is out of service");
    }
    watch_driven();
  }
  if (armed()) return;
  if (path_->mode() == TorquePath::Mode::kHolding) return hold();
  standing_->move();
  send_torques();
}

/// Whatever its controller does, it comes to rest and is held.
void WamHardware::watch_driven() {
  if (!armed()) return;
  const auto why =
      driven_->step({.positions = motion_->positions(),
                     .velocities = motion_->velocities(),
                     .torques = path_->moving_torques(),
                     .weight = path_->weight(),
                     .tip = TipSpeed::of(motion_->positions(), motion_->velocities())});
  if (why) disarm(why->view(), TorquePath::Last::kEndsAtOnce);
}

/// Where it is, and watched: whatever does not fit the arm must not shake it.
void WamHardware::hold() {
  standing_->stand(motion_->velocities());
  if (const auto why =
          standing_->step(motion_->positions(), motion_->velocities(), path_->moving_torques())) {
    leave_service();
    return fault(*why);  // which has the pucks braked
  }
  path_->step_hold(link_->now());
  send_torques();
}

void WamHardware::on_torque(const Vector& torques) {
  if (!armed() || std::exchange(commanded_, true)) return;
  const auto result = path_->step_drive(torques, link_->now());
  clipped_.assign(path_->clipped());
  if (result == TorquePath::Result::kNotFinite) disarm("a torque is no finite number");
  send_torques();
}

void WamHardware::on_position(const Vector& reference) {
  if (!motion_->known()) return;
  const base::Duration pause = kMostWithoutCommand * parameters_.period().duration();
  if (base::later(followed_, pause) < time()) {
    own_controller_->reset_to(reference, motion_->positions());
  }
  followed_ = time();
  own_controller_->step(reference, motion_->positions(), own_torques_);
  control_data_.write(own_torques_);
}

void WamHardware::send_torques() {
  const base::Time now = link_->now();
  const std::span<const double> torques = path_->motor_torques();
  for (std::size_t i = 0; i < torques.size(); ++i) driver_->set_torque(i, torques[i], now);
  driver_->send_torques(now);
  std::ranges::copy(path_->joint_torques(), sent_.begin());
  sent_torques_.write(sent_);
}

// ---- Whether it may stop

/// Of the joint that is farthest [rad].
double WamHardware::from_home() const {
  double most = 0.0;
  for (std::size_t i = 0; i < path_->joints(); ++i) {
    most = std::max(most, std::abs(motion_->positions()[i] - numbers_->home[i]));
  }
  return most;
}

component::Reason WamHardware::held() {
  if (path_->mode() == TorquePath::Mode::kOff || !motion_->known()) return {};
  if (held_by_hand_.said() || from_home() < kAtHome) return {};
  component::Reason what("the arm's weight away from home: ");
  what.append(armed() ? "" : "arm it, then ")
      .append("say ")
      .append(name())
      .append(":moveHome(); or ");
  return what.append("hold it, and say ").append(name()).append(".held_by_hand = true");
}

// ---- Arming

void WamHardware::on_arm() {
  if (armed()) return;
  if (!path_->begin_to_drive()) {
    log_error("not armed: the arm is not active, it waits for {}", waits_for_.get().view());
    return tell_armed(false);
  }
  held_by_hand_.withdraw();
  standing_->move();
  driven_->begin();
  followed_ = base::Time::min();
  without_command_ = 0;
  commanded_ = true;  // from the next cycle on
  tell_armed(true);
  log_info("armed");
}

void WamHardware::disarm(std::string_view why, TorquePath::Last driven) {
  const bool was_armed = armed();
  if (was_armed) path_->begin_to_hold(driven);
  tell_armed(false);
  if (was_armed) log_warning("disarmed, and holds the arm where it is: {}", why);
  if (move_home_.active()) move_home_.fail("disarmed");
}

void WamHardware::tell_armed(bool armed) {
  for (std::size_t i = 0; i < armed_.size(); ++i) armed_[i].write(armed);
}

// ---- Commands

/// In whichever thread; it knows nothing but the arm's shape.
double WamHardware::motion_limit_used(const Vector& positions, const Vector& velocities) {
  const auto joints = static_cast<std::size_t>(joints_.get());
  const bool fit = positions.size() == joints && velocities.size() == joints;
  if (!fit) return std::numeric_limits<double>::infinity();
  return TipSpeed::of(positions, velocities) / kFastestTip;
}

Outcome WamHardware::move_home() {
  if (!armed()) return component::refused("the arm is not armed");
  if (!generator_.bound()) return component::refused("it has no peer with a command moveTo");
  home_asked_at_ = time();
  home_by_limits_ = false;
  send_home(home_time());
  if (home_motion_.stage() == CommandStage::kRefused) send_home(0.0);  // short ways take longer
  if (home_motion_.stage() != CommandStage::kRefused) return component::accepted();
  return component::refused(home_motion_.reason());
}

/// Of a motion of which no part is faster than twice its mean.
double WamHardware::home_time() const {
  double length = 0.0;
  for (std::size_t i = 0; i < path_->joints(); ++i) {
    length = std::hypot(length, numbers_->home[i] - motion_->positions()[i]);
  }
  return 2.0 * length / kHomeRate;
}

/// @param time_s  0: as long as the limits demand
void WamHardware::send_home(double time_s) {
  const rt::PermitScope first_target_makes_room;
  home_motion_ = generator_.send(numbers_->home, time_s);
}

void WamHardware::follow_home() {
  move_home_.report(home_motion_.progress());
  if (!home_motion_.ended()) return;
  // A motion that was cancelled comes to rest first.
  const bool in_time = time() - home_asked_at_ < kRestTime;
  if (home_motion_.stage() == CommandStage::kRefused && in_time) {
    // It rests already if only the time is refused, which is too short for a short way.
    home_by_limits_ = !home_by_limits_;
    return send_home(home_by_limits_ ? 0.0 : home_time());
  }
  if (home_motion_.stage() == CommandStage::kDone) {
    move_home_.complete();
  } else {
    move_home_.fail(home_motion_.reason());
  }
}

Outcome WamHardware::press(void (WamHardware::*key)(), component::Command<>& command) {
  if (emulated_ == nullptr) {
    if (bus_.get() == "emulator")
      return component::refused("the arm is emulated once it is configured");
    component::Reason why("the arm on ");
    return component::refused(
        why.append(bus_.get()).append(" has an operator and a pendant of its own"));
  }
  (this->*key)();
  command.complete();
  return component::accepted();
}

}  // namespace armature::wam
