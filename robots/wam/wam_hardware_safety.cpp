// SPDX-License-Identifier: Apache-2.0
// WamHardware: what the safety board, the pucks and the bus say, and what becomes of it.
#include <charconv>
#include <chrono>
#include <iterator>
#include <utility>

#include "armature/base/seconds.hpp"
#include "robots/wam/driver/safety_text.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {
namespace {

/// Until then the board says why it went to idle; the driver asks it at once.
constexpr base::Duration kIdleCauseTime = std::chrono::milliseconds(150);
/// Until then it says whether it was E-stop that made pucks silent, and those that can hear answer.
constexpr base::Duration kSilenceCauseTime = std::chrono::milliseconds(30);
/// Until then it has cut the power of those that do not.
constexpr base::Duration kPowerCutTime = std::chrono::milliseconds(50);
/// A board that has not answered for so long is silent.
constexpr base::Duration kSilentBoardTime = std::chrono::milliseconds(150);
/// Between two keys of the emulated operator.
constexpr base::Duration kKeyTime = std::chrono::milliseconds(100);

}  // namespace

/// @return it runs on
bool WamHardware::supervise() {
  tell_safety_state();
  const WamFault fault = driver_->fault();
  if (fault == WamFault::kNone) {
    watch_activation();
  } else if (fault == WamFault::kIdled) {
    wait_for_cause();
  } else if (fault == WamFault::kPuckSilent) {
    wait_for_puck();
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
                     : " s before it was not listened to any more");
  safety_state_.assign(told);
}

/// Out of service at once, to look for the cause.
/// @return since when
base::Duration WamHardware::be_out() {
  if (!out_since_) {
    out_since_ = link_->now();
    leave_service();
  }
  return link_->now() - *out_since_;
}

/// A fault of the board becomes one of this component; without one it was the operator who idled
/// the arm.
void WamHardware::wait_for_cause() {
  if (be_out() < kIdleCauseTime) return;
  out_since_.reset();
  driver_->acknowledge();
  log_warning("the operator has idled the arm; it is disarmed");
}

/// A puck that answers again has heard that it is idle. Of one that does not, nobody knows what it
/// drives its motor with.
void WamHardware::wait_for_puck() {
  const base::Duration past = be_out();
  driver_->send_idle();  // in each cycle: it may have missed the last
  if (past < kSilenceCauseTime) return;
  if (past >= kPowerCutTime || !driver_->any_silent()) return take_out(WamFault::kPuckSilent);
  if (driver_->needs_power_cut() && !std::exchange(cuts_power_, true)) {
    driver_->cut_power(link_->now());
  }
}

void WamHardware::watch_activation() {
  if (driver_->board_mode() == BoardMode::kIdle) idle_seen_ = true;
  if (!driver_->board_mode() || !motion_->known()) return;
  if (!driver_->active() || !idle_seen_) return ask_for_activation();
  if (path_->mode() != TorquePath::Mode::kOff) return;
  asks_ = false;
  waits_for_.assign({});
  path_->begin_to_hold();
  if (emulated_ != nullptr) emulated_->let_go();
  log_info("holds the arm where it is");
}

void WamHardware::ask_for_activation() {
  const std::string_view request = activation_request(driver_->pendant(), !idle_seen_);
  if (waits_for_.get().view() != request) {
    waits_for_.assign(request);
    log_warning("waits for {}", request);
  }
  if (emulated_ != nullptr && emulated_operator_) help_to_activate();
}

/// A key at a time, once it was asked for.
void WamHardware::help_to_activate() {
  const base::Time now = link_->now();
  if (!asks_) pressed_at_ = now;
  asks_ = true;
  if (now - pressed_at_ < kKeyTime) return;
  pressed_at_ = now;
  const bool first_idle = !idle_seen_ || (driver_->pendant() && shows_fault(*driver_->pendant()));
  first_idle ? press_idle() : press_activate();
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
  followed_ = base::Time::min();
  tell_armed(false);
  if (move_home_.active()) move_home_.fail("the arm is not active any more");
}

/// Pucks that are idle brake their motors.
void WamHardware::make_safe() {
  held_by_hand_.withdraw();
  if (!driver_) return;  // it was not configured
  note_last_safety_state();
  path_->go_off();
  send_torques();
  driver_->send_idle();
  guard_.rest();
  tell_armed(false);
}

}  // namespace armature::wam
