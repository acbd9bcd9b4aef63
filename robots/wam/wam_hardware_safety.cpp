// SPDX-License-Identifier: Apache-2.0
// Of WamHardware: what the guardian, the safety board, the pucks and the bus say, and what becomes
// of it.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

#include "armature/base/seconds.hpp"
#include "robots/wam/driver/safety_text.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {
namespace {

/// A board that has not answered for so long is silent.
constexpr base::Duration kSilentBoardTime = std::chrono::milliseconds(150);
/// [rad] Nearer each joint lies where it may be let go of.
constexpr double kAtHome = 0.05;

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
}

void WamHardware::ask_for_activation() {
  const std::string_view request = activation_request(driver_->pendant(), !idle_seen_);
  if (waits_for_.get().view() != request) {
    waits_for_.assign(request);
    log_warning("waits for {}", request);
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

}  // namespace armature::wam
