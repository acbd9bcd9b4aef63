// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/power.hpp"

namespace armature::cia402 {

const char* to_text(PowerState state) noexcept {
  switch (state) {
    case PowerState::kNotReadyToSwitchOn:
      return "not ready to switch on";
    case PowerState::kSwitchOnDisabled:
      return "switch on disabled";
    case PowerState::kReadyToSwitchOn:
      return "ready to switch on";
    case PowerState::kSwitchedOn:
      return "switched on";
    case PowerState::kOperationEnabled:
      return "operation enabled";
    case PowerState::kQuickStopActive:
      return "quick stop active";
    case PowerState::kFaultReactionActive:
      return "fault reaction active";
    case PowerState::kFault:
      return "fault";
  }
  return "unknown";
}

std::optional<PowerState> decode_status(std::uint16_t status) noexcept {
  // Of these states the quick stop bit tells nothing.
  switch (status & 0x4f) {
    case 0x00:
      return PowerState::kNotReadyToSwitchOn;
    case 0x40:
      return PowerState::kSwitchOnDisabled;
    case 0x0f:
      return PowerState::kFaultReactionActive;
    case 0x08:
      return PowerState::kFault;
    default:
      break;
  }
  switch (status & 0x6f) {
    case 0x21:
      return PowerState::kReadyToSwitchOn;
    case 0x23:
      return PowerState::kSwitchedOn;
    case 0x27:
      return PowerState::kOperationEnabled;
    case 0x07:
      return PowerState::kQuickStopActive;
    default:
      return std::nullopt;
  }
}

std::uint16_t encode_state(PowerState state) noexcept {
  switch (state) {
    case PowerState::kNotReadyToSwitchOn:
      return 0x00;
    case PowerState::kSwitchOnDisabled:
      return 0x40;
    case PowerState::kReadyToSwitchOn:
      return 0x21;
    case PowerState::kSwitchedOn:
      return 0x23;
    case PowerState::kOperationEnabled:
      return 0x27;
    case PowerState::kQuickStopActive:
      return 0x07;
    case PowerState::kFaultReactionActive:
      return 0x0f;
    case PowerState::kFault:
      return 0x08;
  }
  return 0x00;
}

PowerCommand decode_control(std::uint16_t control) noexcept {
  using namespace control_bit;
  if ((control & kEnableVoltage) == 0) return PowerCommand::kDisableVoltage;
  if ((control & kQuickStop) == 0) return PowerCommand::kQuickStop;
  if ((control & kSwitchOn) == 0) return PowerCommand::kShutdown;
  return (control & kEnableOperation) != 0 ? PowerCommand::kEnableOperation
                                           : PowerCommand::kSwitchOn;
}

std::uint16_t encode_command(PowerCommand command) noexcept {
  switch (command) {
    case PowerCommand::kDisableVoltage:
      return 0x00;
    case PowerCommand::kQuickStop:
      return 0x02;
    case PowerCommand::kShutdown:
      return 0x06;
    case PowerCommand::kSwitchOn:
      return 0x07;
    case PowerCommand::kEnableOperation:
      return 0x0f;
  }
  return 0x00;
}

namespace {

PowerCommand toward_ready(PowerState state) noexcept {
  switch (state) {
    case PowerState::kSwitchOnDisabled:
    case PowerState::kReadyToSwitchOn:
    case PowerState::kSwitchedOn:
    case PowerState::kOperationEnabled:
      return PowerCommand::kShutdown;
    default:
      return PowerCommand::kDisableVoltage;
  }
}

PowerCommand toward_switched_on(PowerState state) noexcept {
  switch (state) {
    case PowerState::kReadyToSwitchOn:
    case PowerState::kSwitchedOn:
    case PowerState::kOperationEnabled:
      return PowerCommand::kSwitchOn;
    default:
      return toward_ready(state);
  }
}

PowerCommand toward_enabled(PowerState state) noexcept {
  switch (state) {
    case PowerState::kSwitchedOn:
    case PowerState::kOperationEnabled:
      return PowerCommand::kEnableOperation;
    default:
      return toward_switched_on(state);
  }
}

}  // namespace

PowerCommand next_command(PowerState state, PowerGoal goal) noexcept {
  switch (goal) {
    case PowerGoal::kOff:
      return PowerCommand::kDisableVoltage;
    case PowerGoal::kReady:
      return toward_ready(state);
    case PowerGoal::kSwitchedOn:
      return toward_switched_on(state);
    case PowerGoal::kEnabled:
      return toward_enabled(state);
    case PowerGoal::kQuickStop:
      return state == PowerState::kOperationEnabled || state == PowerState::kQuickStopActive
                 ? PowerCommand::kQuickStop
                 : PowerCommand::kDisableVoltage;
  }
  return PowerCommand::kDisableVoltage;
}

void PowerControl::set_goal(PowerGoal goal) noexcept {
  goal_ = goal;
  reached_ = false;
}

/// By itself, or by somebody else's word.
bool PowerControl::has_fallen(PowerState state) noexcept {
  const bool enabled = state == PowerState::kOperationEnabled;
  const bool there = goal_ == PowerGoal::kEnabled      ? enabled
                     : goal_ == PowerGoal::kSwitchedOn ? enabled || state == PowerState::kSwitchedOn
                                                       : true;
  reached_ = reached_ || there;
  return reached_ && !there;
}

std::uint16_t PowerControl::step(std::optional<PowerState> state) noexcept {
  const bool failed = state == PowerState::kFault || state == PowerState::kFaultReactionActive;
  if (failed) return in_fault();
  reset_asked_ = false;
  resetting_ = false;
  // A quick stop that the drive or somebody else began goes on to its end; only `kOff` cuts it
  // short.
  if (state == PowerState::kQuickStopActive && goal_ != PowerGoal::kOff) {
    goal_ = PowerGoal::kQuickStop;
  }
  if (!state) return encode_command(PowerCommand::kDisableVoltage);
  if (has_fallen(*state)) set_goal(PowerGoal::kOff);
  return encode_command(next_command(*state, goal_));
}

std::uint16_t PowerControl::in_fault() noexcept {
  goal_ = PowerGoal::kOff;
  // The bit is low for a step before it rises, whatever was sent before.
  const bool rises = reset_asked_ && resetting_;
  const std::uint16_t off = encode_command(PowerCommand::kDisableVoltage);
  if (rises) {
    reset_asked_ = false;
    resetting_ = false;
    return off | control_bit::kFaultReset;
  }
  resetting_ = reset_asked_;
  return off;
}

void PowerMachine::take_control(std::uint16_t control) noexcept {
  const bool reset = (control & control_bit::kFaultReset) != 0;
  const bool rises = reset && !reset_bit_;
  reset_bit_ = reset;
  if (state_ == PowerState::kFault) {
    if (rises) state_ = PowerState::kSwitchOnDisabled;
    return;
  }
  obey(decode_control(control));
}

void PowerMachine::obey(PowerCommand command) noexcept {
  const bool powered = state_ == PowerState::kReadyToSwitchOn ||
                       state_ == PowerState::kSwitchedOn || state_ == PowerState::kOperationEnabled;
  switch (command) {
    case PowerCommand::kDisableVoltage:
      if (powered || state_ == PowerState::kQuickStopActive) state_ = PowerState::kSwitchOnDisabled;
      return;
    case PowerCommand::kQuickStop:
      if (state_ == PowerState::kOperationEnabled) {
        state_ = PowerState::kQuickStopActive;
      } else if (powered) {
        state_ = PowerState::kSwitchOnDisabled;
      }
      return;
    case PowerCommand::kShutdown:
      if (powered || state_ == PowerState::kSwitchOnDisabled) state_ = PowerState::kReadyToSwitchOn;
      return;
    case PowerCommand::kSwitchOn:
      if (powered) state_ = PowerState::kSwitchedOn;
      return;
    case PowerCommand::kEnableOperation:
      // From ready to switch on it first is switched on (transitions 3 and 4, one at a time).
      if (state_ == PowerState::kReadyToSwitchOn) {
        state_ = PowerState::kSwitchedOn;
      } else if (powered) {
        state_ = PowerState::kOperationEnabled;
      }
      return;
  }
}

void PowerMachine::fail() noexcept {
  if (state_ != PowerState::kFault) state_ = PowerState::kFaultReactionActive;
}

void PowerMachine::standing() noexcept {
  if (state_ == PowerState::kFaultReactionActive) state_ = PowerState::kFault;
  if (state_ == PowerState::kQuickStopActive && !stays_) state_ = PowerState::kSwitchOnDisabled;
}

}  // namespace armature::cia402
