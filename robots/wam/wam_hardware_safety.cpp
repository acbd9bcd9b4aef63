// SPDX-License-Identifier: Apache-2.0
// Of WamHardware: what the guardian, the safety board, the pucks and the bus say, and what becomes
// of it; what the operator says: arming, commands.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "armature/base/seconds.hpp"
#include "robots/wam/driver/safety_text.hpp"
#include "robots/wam/tip_speed.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {

using component::Outcome;

namespace {

/// A board that has not answered for so long is silent.
constexpr base::Duration kSilentBoardTime = std::chrono::milliseconds(150);
/// [rad] Nearer each joint lies where it may be let go of.
constexpr double kAtHome = 0.05;
/// [m/s] of a motion: the board idles the arm at 1 m/s, and what follows overshoots a little.
constexpr double kFastestTip = 0.95;
/// [rad/s] Slower, a joint rests.
constexpr double kRestVelocity = 0.1;

}  // namespace

/// @return it runs on
bool WamHardware::is_guarded() {
  if (const auto reason = guard_.beat(time())) {
    leave_service();
    fault(reason->view());
    return false;
  }
  if (guard_.take_loss()) {
    log_error("its guardian has died: if this process does, the pucks' watchdogs stop the arm");
  }
  return true;
}

/// @return it runs on
bool WamHardware::supervise() {
  tell_safety_state();
  const WamFault fault = driver_->fault();
  if (fault == WamFault::kNone) {
    watch_activation();
  } else if (fault == WamFault::kIdled || fault == WamFault::kPuckSilent) {
    look_for_cause(fault);
  } else {
    take_out(fault);
  }
  return state() == component::State::kRunning;
}

void WamHardware::tell_safety_state() {
  const auto mode = driver_->board_mode();
  board_state_.write(state_of_safety(mode));
  const std::string_view told = safety_state(mode);
  if (mode) safety_state_age_.assign(base::to_seconds(link_->now() - driver_->board_mode_time()));
  if (safety_state_.get().view() == told) return;
  safety_state_.assign(told);
  if (mode) log_info("the safety board is in {}", told);
}

/// From now on nobody listens to the board: what it said last gets old.
void WamHardware::note_last_safety_state() {
  if (!driver_->board_mode()) return safety_state_.assign(safety_state({}));
  char room[32];
  const auto end = std::to_chars(std::begin(room), std::end(room), safety_state_age_(),
                                 std::chars_format::fixed, 2);
  component::Reason told(safety_state(driver_->board_mode()));
  told.append(", said last ").append({room, static_cast<std::size_t>(end.ptr - room)});
  const bool silent = safety_state_age_() > base::to_seconds(kSilentBoardTime);
  told.append(silent ? " s before it was found silent"
                     : " s before this process stopped listening to it");
  safety_state_.assign(told);
}

/// Out of service at once. A fault of the board becomes one of this component.
void WamHardware::look_for_cause(WamFault fault) {
  if (!cause_.under_way()) {
    cause_.begin(link_->now());
    leave_service();
  }
  const CauseSearch::Found found = fault == WamFault::kIdled
                                       ? cause_.look_at_idle(link_->now())
                                       : cause_.look_at_silence(*driver_, link_->now());
  if (found == CauseSearch::Found::kFault) take_out(fault);
  if (found != CauseSearch::Found::kOperator) return;
  driver_->acknowledge();
  log_warning("the operator has idled the arm; it is disarmed");
}

void WamHardware::watch_activation() {
  if (driver_->board_mode() == BoardMode::kIdle) idle_seen_ = true;
  if (!driver_->board_mode() || !motion_->known()) return;
  if (!driver_->active() || !idle_seen_) return ask_for_activation();
  if (path_->mode() != TorquePath::Mode::kOff) return;
  if (operator_) operator_->rest();
  waits_for_.assign({});
  path_->begin_to_hold();
  if (operator_) operator_->let_go();
  log_info("holds the arm where it is");
  if (after_activation_ == AfterActivation::kWeightless) float_gate_->begin();
}

// ---- Weightless

/// Once after each activation, and only if the deployment says so.
void WamHardware::begin_to_float() {
  const auto verdict = float_gate_->step(motion_->velocities(), path_->moving_torques());
  if (verdict == FloatGate::Verdict::kStays) {
    return log_warning("stays held, and is not weightless: {}", float_gate_->why().view());
  }
  if (verdict == FloatGate::Verdict::kNone || !path_->begin_to_float()) return;
  standing_->move();
  driven_->begin();
  driven_->rest();
  weightless_.assign(true);
  log_warning("the arm is weightless: lead it by hand; disarming or arming holds it");
}

/// It goes on as long as a hand leads it; a load, or a joint that is too fast, ends it.
void WamHardware::float_on() {
  const auto why =
      driven_->step({.positions = motion_->positions(),
                     .velocities = motion_->velocities(),
                     .torques = path_->moving_torques(),
                     .weight = path_->weight(),
                     .tip = TipSpeed::of(motion_->positions(), motion_->velocities())});
  if (why) {
    end_floating(why->view(), TorquePath::Last::kEndsAtOnce);
    return hold();
  }
  path_->step_float(link_->now());
  send_torques();
  watch_pucks();
}

/// @return false, and it goes on as it was, if a joint moves
bool WamHardware::hold_again() {
  const auto moves = [](double velocity) { return !(std::abs(velocity) < kRestVelocity); };
  if (std::ranges::any_of(motion_->velocities(), moves)) return false;
  end_floating("it is to be armed", TorquePath::Last::kDiesAway);
  return true;
}

void WamHardware::end_floating(std::string_view why, TorquePath::Last driven) {
  path_->begin_to_hold(driven);
  weightless_.assign(false);
  log_warning("no longer weightless, and holds the arm where it is: {}", why);
}

void WamHardware::on_disarm() {
  float_gate_->close();
  if (path_->mode() == TorquePath::Mode::kWeightless) {
    end_floating("the operator disarmed it", TorquePath::Last::kDiesAway);
  }
  disarm("the operator disarmed it");
}

void WamHardware::ask_for_activation() {
  const std::string_view request = activation_request(driver_->pendant(), !idle_seen_);
  if (waits_for_.get().view() != request) {
    waits_for_.assign(request);
    const bool floats = after_activation_ == AfterActivation::kWeightless;
    log_warning("waits for {}{}", request,
                floats ? "; then it becomes weightless: hold it when you press it" : "");
  }
  if (!operator_ || !emulated_operator_) return;
  const bool idle_first = !idle_seen_ || (driver_->pendant() && shows_fault(*driver_->pendant()));
  operator_->help_to_activate(idle_first, link_->now());
}

void WamHardware::take_out(WamFault why) {
  positions_lost_ = loses_positions(why);
  at_home_.withdraw();
  const int node = driver_->fault_node();
  const bool deaf =
      why == WamFault::kNoBus || (why == WamFault::kPuckSilent && driver_->any_silent());
  leave_service();
  waits_for_.assign({});
  fault(fault_reason(why, node, deaf));
}

void WamHardware::leave_service() {
  path_->go_off();
  weightless_.assign(false);
  followed_ = base::Time::min();
  tell_armed(false);
  if (move_home_.active()) move_home_.fail("the arm is no longer active");
}

/// Pucks that are idle brake their motors.
void WamHardware::make_safe() {
  held_by_hand_.withdraw();
  if (!driver_) return;  // it was not configured
  note_last_safety_state();
  path_->go_off();
  weightless_.assign(false);
  send_torques();
  driver_->send_idle();
  guard_.rest();
  tell_armed(false);
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
      .append("call ")
      .append(name())
      .append(":moveHome(); or ");
  return what.append("hold it, and set ").append(name()).append(".held_by_hand = true");
}

// ---- Arming

/// A weightless arm is held first, and only where no hand moves it.
void WamHardware::on_arm() {
  if (armed()) return;
  if (path_->mode() == TorquePath::Mode::kWeightless && !hold_again()) {
    log_error("not armed: the weightless arm moves; let it rest, and arm it again");
    return tell_armed(false);
  }
  float_gate_->close();
  if (!path_->begin_to_drive()) {
    log_error("not armed: the arm is not active, it waits for {}", waits_for_.get().view());
    return tell_armed(false);
  }
  held_by_hand_.withdraw();
  standing_->move();
  driven_->begin();
  followed_ = base::Time::min();
  without_command_ = 0;
  why_without_ = {};
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

/// What a hand does to a real arm needs no operation.
bool WamHardware::lead_by_hand(const Vector& velocities) {
  const bool fit = velocities.size() == static_cast<std::size_t>(joints_.get()) &&
                   std::ranges::all_of(velocities, [](double each) { return std::isfinite(each); });
  if (emulated() == nullptr || !fit) return false;
  emulated()->motors().push(velocities);
  return true;
}

Outcome WamHardware::move_home() {
  if (!armed()) return component::refused("the arm is not armed");
  return way_home_.begin({numbers_->home, motion_->positions(), time()});
}

void WamHardware::follow_home() {
  move_home_.report(way_home_.progress());
  if (!way_home_.follow({numbers_->home, motion_->positions(), time()})) return;
  if (way_home_.done()) {
    move_home_.complete();
  } else {
    move_home_.fail(way_home_.reason());
  }
}

Outcome WamHardware::press(void (EmulatedOperator::*key)(), component::Command<>& command) {
  if (!operator_) {
    if (bus_.get() == "emulator")
      return component::refused("the arm is emulated once it is configured");
    component::Reason why("the arm on ");
    return component::refused(
        why.append(bus_.get()).append(" has an operator and a pendant of its own"));
  }
  ((*operator_).*key)();
  command.complete();
  return component::accepted();
}

}  // namespace armature::wam
