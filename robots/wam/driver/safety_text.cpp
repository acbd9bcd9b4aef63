// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/safety_text.hpp"

#include <algorithm>
#include <charconv>

namespace armature::wam {
namespace {

component::Reason of_puck(int node, std::string_view what) {
  if (node == kEveryNode) return component::Reason("every puck").append(what);
  char digits[12];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), node).ptr;
  component::Reason reason("puck ");
  return reason.append({digits, static_cast<std::size_t>(end - digits)}).append(what);
}

}  // namespace

std::string_view safety_state(std::optional<BoardMode> mode) {
  if (!mode) return "unknown";
  switch (*mode) {
    case BoardMode::kEstop:
      return "E-STOP";
    case BoardMode::kIdle:
      return "IDLE";
    case BoardMode::kActive:
      return "ACTIVATED";
  }
  return "unknown";
}

namespace {

component::Reason cause_of(WamFault fault, int node) {
  switch (fault) {
    case WamFault::kNone:
      return "";
    case WamFault::kNoBus:
      return "the bus is off or unplugged: check cable and power, then reset, start, arm";
    case WamFault::kPuckSilent:
      if (node == kEveryNode) {
        return "every puck is silent: check bus and power, and that an arm that another process "
               "emulates keeps up, then reset, start, arm";
      }
      return of_puck(node, " is silent: check its cable and power, then reset, start, arm");
    case WamFault::kPowerCut:
      return of_puck(
          node,
          " is silent, and may drive on as it was told last, so its power was cut: check "
          "its cable, put the arm at home, then reset, cleanup, start");
    case WamFault::kPositionJump:
      return of_puck(node,
                     " told a position that cannot be, its zero is lost: put the arm at home, then "
                     "reset, cleanup, start");
    case WamFault::kBoardSilent:
      return "the safety board is silent: check its cable and power, then reset, start, arm";
    case WamFault::kEstop:
      return "E-stop, positions are lost: put the arm at home, release the button, then reset, "
             "cleanup, start";
    case WamFault::kIdled:
      return "the safety board is idle: press Shift+Activate, then arm";
    case WamFault::kVelocity:
      return "velocity fault of the safety board, the arm was too fast: Shift+Idle clears it, then "
             "reset, start, arm";
    case WamFault::kTorque:
      return "torque fault of the safety board, a torque was too large: Shift+Idle clears it, then "
             "reset, start, arm";
    case WamFault::kVoltage:
      return "voltage fault of the safety board: check the supply, clear it with Shift+Idle, then "
             "reset, start, arm";
    case WamFault::kHeartbeat:
      return "heartbeat fault of the safety board, it heard no cycles: Shift+Idle clears it, then "
             "reset, start, arm";
    case WamFault::kOther:
      return "a fault of the safety board that it does not name: Shift+Idle clears it, then reset, "
             "start, arm";
  }
  return "";
}

}  // namespace

component::Reason fault_reason(WamFault fault, int node, bool may_drive_on) {
  component::Reason reason(may_drive_on ? "press E-stop, motors may go on as they were told last; "
                                        : "");
  return reason.append(cause_of(fault, node));
}

std::string_view activation_request(const std::optional<PendantWord>& pendant, bool was_active) {
  if (was_active) {
    return "Shift+Idle, then Shift+Activate: the arm was active before, and is not sure to obey";
  }
  if (pendant && shows_fault(*pendant)) {
    return "Shift+Idle, which clears the fault that the pendant shows, then Shift+Activate";
  }
  return "Shift+Activate: the arm is braked; active, it holds where it is until it is armed";
}

bool shows_fault(const PendantWord& pendant) {
  return std::ranges::find(pendant.levels, Level::kFault) != pendant.levels.end();
}

}  // namespace armature::wam
