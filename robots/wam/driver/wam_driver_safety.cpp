// SPDX-License-Identifier: Apache-2.0
// WamDriver: what the safety board says, what pucks do not, and which fault that is.
#include <algorithm>
#include <ranges>
#include <utility>

#include "robots/wam/driver/wam_driver.hpp"

namespace armature::wam {
namespace {

WamFault fault_of(Monitor monitor) {
  switch (monitor) {
    case Monitor::kVelocity:
      return WamFault::kVelocity;
    case Monitor::kTorque:
      return WamFault::kTorque;
    case Monitor::kVoltage:
      return WamFault::kVoltage;
    case Monitor::kHeartbeat:
      return WamFault::kHeartbeat;
    case Monitor::kOther:
      return WamFault::kOther;
  }
  return WamFault::kOther;
}

/// Of two that are found in the same arm: what stops it for good, and then which positions are
/// wrong.
int weight_of(WamFault fault) {
  if (fault == WamFault::kNone) return 0;
  if (fault == WamFault::kEstop || fault == WamFault::kPowerCut) return 3;
  return fault == WamFault::kPositionJump ? 2 : 1;
}

}  // namespace

bool loses_positions(WamFault fault) { return weight_of(fault) > 1; }

const char* to_text(WamFault fault) {
  switch (fault) {
    case WamFault::kNone:
      return "none";
    case WamFault::kNoBus:
      return "no bus";
    case WamFault::kPuckSilent:
      return "puck silent";
    case WamFault::kPowerCut:
      return "power cut";
    case WamFault::kPositionJump:
      return "position jump";
    case WamFault::kBoardSilent:
      return "safety board silent";
    case WamFault::kEstop:
      return "E-stop";
    case WamFault::kIdled:
      return "idled";
    case WamFault::kVelocity:
      return "velocity";
    case WamFault::kTorque:
      return "torque";
    case WamFault::kVoltage:
      return "voltage";
    case WamFault::kHeartbeat:
      return "heartbeat";
    case WamFault::kOther:
      return "other";
  }
  return "?";
}

// ---- Pucks

/// The board knows whether it was E-stop that took the puck's power.
void WamDriver::judge_silence(std::size_t motor, base::Time now) {
  if (!silent(motor)) return;
  const int node = motors_[motor].node;
  if (accounts_[motor].doubtful) return raise(WamFault::kPositionJump, node);
  if (fault_ != WamFault::kNone) return;
  const bool others_are_too =
      std::ranges::all_of(std::views::iota(std::size_t{0}, arm_.motors),
                          [this](std::size_t each) { return silent(each); });
  raise(WamFault::kPuckSilent, others_are_too ? kEveryNode : node);
  board_heard_ = false;
  watch_.ask_mode_soon(now);
}

bool WamDriver::any_silent() const {
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) {
    if (silent(motor)) return true;
  }
  return false;
}

can::SendStatus WamDriver::cut_power(base::Time now) {
  cuts_power_ = true;
  watch_.ask_mode_soon(now);
  return send(
      set_frame(to_node(kBoardNode), arm_.board_mode_number, static_cast<int>(BoardMode::kEstop)));
}

// ---- The safety board

void WamDriver::judge_board(base::Time now) {
  board_heard_ = true;
  if (const auto before = std::exchange(mode_seen_, watch_.mode());
      before && *before != *mode_seen_) {
    judge_drop(*before, now);
  }
  if (mode_seen_ == BoardMode::kEstop) {
    cuts_power_ ? raise(WamFault::kPowerCut, fault_node_) : raise(WamFault::kEstop);
  }
  if (std::exchange(pendants_seen_, watch_.pendant_answers()) != watch_.pendant_answers()) {
    name_drop(now);
  }
}

void WamDriver::judge_drop(BoardMode before, base::Time now) {
  if (before != BoardMode::kActive || watch_.mode() != BoardMode::kIdle) return;
  raise(WamFault::kIdled);
  watch_.ask_pendant_soon(now);
}

/// To the board a puck that lost its zero is one whose motor was too fast, so such a puck is waited
/// for: the board's name would have its positions believed.
void WamDriver::name_drop(base::Time now) {
  if (fault_ != WamFault::kIdled || !watch_.pendant()) return;
  if (std::ranges::any_of(accounts_, &Account::doubtful)) return watch_.ask_pendant_soon(now);
  for (std::size_t i = 0; i < kMonitors; ++i) {
    const auto monitor = static_cast<Monitor>(i);
    if (watch_.pendant()->level(monitor) != Level::kFault) continue;
    fault_ = fault_of(monitor);
    return;
  }
}

void WamDriver::raise(WamFault fault, int node) {
  if (weight_of(fault) <= weight_of(fault_)) return;
  fault_ = fault;
  fault_node_ = node;
  clear_torques();
  if (fault != WamFault::kPositionJump) return;
  // Whoever starts the arm up next has to write its home position again.
  static_cast<void>(send(set_frame(to_node(kBoardNode), arm_.zero_number, 0)));
}

bool WamDriver::acknowledge() {
  if (loses_positions(fault_)) return false;
  fault_ = WamFault::kNone;
  fault_node_ = 0;
  clear_torques();
  for (WamMotor& each : motors_) {
    each.known = each.known && each.cycles_without < config_.most_without;
    each.cycles_without = 0;
  }
  return true;
}

}  // namespace armature::wam
