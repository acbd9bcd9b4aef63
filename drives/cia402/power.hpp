// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace armature::cia402 {

/// States of a drive's power (CiA 402-2, figure 3).
enum class PowerState : std::uint8_t {
  kNotReadyToSwitchOn,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault,
};
const char* to_text(PowerState state) noexcept;

/// Bits of the status word, object 0x6041.
namespace status_bit {
constexpr std::uint16_t kReadyToSwitchOn = 0x0001;
constexpr std::uint16_t kSwitchedOn = 0x0002;
constexpr std::uint16_t kOperationEnabled = 0x0004;
constexpr std::uint16_t kFault = 0x0008;
constexpr std::uint16_t kVoltageEnabled = 0x0010;
constexpr std::uint16_t kQuickStop = 0x0020;  ///< 0: a quick stop is under way
constexpr std::uint16_t kSwitchOnDisabled = 0x0040;
constexpr std::uint16_t kWarning = 0x0080;
constexpr std::uint16_t kRemote = 0x0200;
constexpr std::uint16_t kTargetReached = 0x0400;
constexpr std::uint16_t kInternalLimit = 0x0800;
constexpr std::uint16_t kFollowsCommand = 0x1000;  ///< of CSP, CSV, CST; of HM: homing attained
constexpr std::uint16_t kAcknowledge = 0x1000;     ///< of PP: the set-point is taken
constexpr std::uint16_t kFollowingError = 0x2000;  ///< of CSP and PP; of HM: homing error
}  // namespace status_bit

/// Bits of the control word, object 0x6040.
namespace control_bit {
constexpr std::uint16_t kSwitchOn = 0x0001;
constexpr std::uint16_t kEnableVoltage = 0x0002;
constexpr std::uint16_t kQuickStop = 0x0004;  ///< 0: stop quickly
constexpr std::uint16_t kEnableOperation = 0x0008;
constexpr std::uint16_t kModeSpecific = 0x0010;  ///< PP: new set-point; HM: begin
constexpr std::uint16_t kAtOnce = 0x0020;        ///< PP: without waiting for the one before
constexpr std::uint16_t kRelative = 0x0040;      ///< PP
constexpr std::uint16_t kFaultReset = 0x0080;    ///< counts when it rises
constexpr std::uint16_t kHalt = 0x0100;
}  // namespace control_bit

/// The state that a status word tells; none if its bits are of no state (CiA 402-2, table 30).
/// @rt nonblocking, no allocation
std::optional<PowerState> decode_status(std::uint16_t status) noexcept;

/// The bits of a status word that tell the state; other bits are 0.
/// @rt nonblocking, no allocation
std::uint16_t encode_state(PowerState state) noexcept;

/// What a control word asks of the drive (CiA 402-2, table 28).
enum class PowerCommand : std::uint8_t {
  kDisableVoltage,
  kQuickStop,
  kShutdown,
  kSwitchOn,  ///< and "disable operation", which has the same bits
  kEnableOperation,
};
/// @rt nonblocking, no allocation
PowerCommand decode_control(std::uint16_t control) noexcept;
/// The control word of a command; other bits are 0.
/// @rt nonblocking, no allocation
std::uint16_t encode_command(PowerCommand command) noexcept;

/// How far its host wants a drive to be.
enum class PowerGoal : std::uint8_t {
  kOff,         ///< no voltage at the motor
  kReady,       ///< `kReadyToSwitchOn`
  kSwitchedOn,  ///< powered, without control
  kEnabled,     ///< follows its targets
  kQuickStop,   ///< stops as 0x605A has it, if it is enabled
};

/// The host's side: the control word that brings a drive a step nearer to its goal.
///
/// A fault is left at the operator's word alone: `ask_reset` makes one rising edge of the reset
/// bit. After a fault, a reset or a quick stop, and once a drive that had reached its goal is no
/// more there, a goal counts only when it has been given anew, so a drive never starts again by
/// itself.
class PowerControl {
 public:
  /// @rt nonblocking, no allocation
  void set_goal(PowerGoal goal) noexcept;
  PowerGoal goal() const { return goal_; }
  /// The operator's word. It counts for a drive that is in fault in the next `step`, else not at
  /// all.
  /// @rt nonblocking, no allocation
  void ask_reset() noexcept { reset_asked_ = true; }

  /// The control word to send now; bits of mode and halt are the caller's.
  /// @param state  that the drive's status word tells; none: unknown, which is answered with `kOff`
  /// @rt nonblocking, no allocation
  std::uint16_t step(std::optional<PowerState> state) noexcept;

 private:
  std::uint16_t in_fault() noexcept;
  bool has_fallen(PowerState state) noexcept;

  PowerGoal goal_ = PowerGoal::kOff;
  bool reached_ = false;  ///< the goal, since it was given
  bool reset_asked_ = false;
  bool resetting_ = false;
};

/// The command that leads from `state` to `goal` in one step; faults are not left by it.
/// @rt nonblocking, no allocation
PowerCommand next_command(PowerState state, PowerGoal goal) noexcept;

/// The drive's side: its state by control words, faults and the end of its stops.
class PowerMachine {
 public:
  /// What the drive does after a quick stop (0x605A): whether it stays in `kQuickStopActive`.
  explicit PowerMachine(bool stays_in_quick_stop = false) : stays_(stays_in_quick_stop) {}

  PowerState state() const { return state_; }
  /// Self-test done: transitions 0 and 1.
  void start() noexcept { state_ = PowerState::kSwitchOnDisabled; }
  /// From power-on, before `start`.
  void reset() noexcept { *this = PowerMachine(stays_); }
  /// @rt nonblocking, no allocation
  void take_control(std::uint16_t control) noexcept;
  /// An error has been found: it goes to `kFaultReactionActive`.
  /// @rt nonblocking, no allocation
  void fail() noexcept;
  /// The stop that a quick stop or a fault asked for has ended: the axis stands.
  /// @rt nonblocking, no allocation
  void standing() noexcept;

 private:
  void obey(PowerCommand command) noexcept;

  bool stays_;
  PowerState state_ = PowerState::kNotReadyToSwitchOn;
  bool reset_bit_ = true;  ///< of the last control word; an edge is needed
};

}  // namespace armature::cia402
