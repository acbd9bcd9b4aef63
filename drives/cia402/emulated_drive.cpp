// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/emulated_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drives/canopen/emergency.hpp"
#include "drives/cia402/homing.hpp"
#include "drives/cia402/internal/drive_objects.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using canopen::Address;
using canopen::PdoDirection;

/// Servo drive, CiA 402.
constexpr std::uint32_t kServoDrive = 0x0002'0192;
constexpr double kStanding = 0.01;  // [rad/s]
constexpr double kReached = 0.002;  // [rad], [rad/s]
constexpr base::Duration kMostStopping = std::chrono::seconds(1);
/// Of the connection: its option code (0x6007) is as at power-on, which is a malfunction.
constexpr std::uint16_t kStoppedByMaster = 0x8100;
/// As many periods without SYNC are a fault.
constexpr int kSyncsToMiss = 3;

bool is_cyclic(Mode mode) {
  return mode == Mode::kCyclicPosition || mode == Mode::kCyclicVelocity ||
         mode == Mode::kCyclicTorque;
}

Scaling scaling_of(const Factors& factors) {
  return Scaling::make(factors, PositionUnit::kIncrements).value();
}

}  // namespace

EmulatedDrive::EmulatedDrive(const Config& config, can::Bus& bus, base::Time begin)
    : config_(config),
      scaling_(scaling_of(config.factors)),
      bus_(bus),
      device_({.node = config.node,
               .device_type = kServoDrive,
               .identity = config.identity,
               .name = "Armature emulated drive"},
              bus),
      axis_(config.axis),
      now_(begin) {
  internal::add_drive_objects(device_.dictionary(), config_.factors, scaling_);
  device_.map(PdoDirection::kReceive, 1, canopen::transmission::kAtEverySync,
              {{object::kControlWord, 16}, {object::kTargetPosition, 32}});
  device_.map(PdoDirection::kTransmit, 1, canopen::transmission::kAtEverySync,
              {{object::kStatusWord, 16}, {object::kPosition, 32}, {object::kTorque, 16}});
  device_.set_hooks({.on_reset = [this] { at_power_on(); },
                     .on_sync = [this](base::Time now) { on_sync(now); },
                     .on_pdo = {}});
  at_power_on();
  device_.boot(begin);
}

void EmulatedDrive::at_power_on() {
  machine_.reset();
  machine_.start();
  loops_.reset();
  mode_ = Mode::kNone;
  control_ = 0;
  homed_ = homing_ = homing_failed_ = stopping_ = false;
  demand_ = {axis_.position(), 0.0};
  write_actual();
}

void EmulatedDrive::reboot(base::Time now) { device_.reset(now); }

void EmulatedDrive::set_identity(const canopen::Identity& identity) {
  set({0x1018, 1}, identity.vendor);
  set({0x1018, 2}, identity.product);
  set({0x1018, 3}, identity.revision);
  set({0x1018, 4}, identity.serial);
}

double EmulatedDrive::speed(Address address) const {
  return std::max(scaling_.velocity(number(address)), 1e-6);
}

void EmulatedDrive::advance_to(base::Time now) {
  can::Arrival arrival;
  while (bus_.receive(arrival) == can::ReceiveStatus::kReceived) {
    move_to(arrival.time);
    const bool sync = canopen::origin_of(arrival.frame).service == canopen::Service::kSync;
    if (sync && deaf_to_sync_) continue;
    device_.take(arrival);
    read_commands();
  }
  move_to(now);
  device_.step(now);
}

void EmulatedDrive::move_to(base::Time now) {
  if (now_ + kStep > now) return;
  while (now_ + kStep <= now) {
    now_ += kStep;
    step(now_);
  }
  watch(now_);
  write_actual();
}

void EmulatedDrive::on_sync(base::Time now) {
  sync_period_ = now - last_sync_;
  last_sync_ = now;
  read_commands();
  if (mode_ == Mode::kCyclicPosition && machine_.state() == PowerState::kOperationEnabled) {
    cycle_target_ = scaling_.position(number(object::kTargetPosition)) - offset_;
    const double period =
        std::chrono::duration<double>(std::clamp(sync_period_, kStep, base::Duration(100'000'000)))
            .count();
    demand_.velocity = (cycle_target_ - demand_.position) / period;
  }
  write_actual();
}

void EmulatedDrive::read_commands() {
  const auto control = static_cast<std::uint16_t>(number(object::kControlWord));
  const auto wanted = static_cast<Mode>(number(object::kMode));
  if (wanted != mode_) change_mode(wanted);
  const PowerState before = machine_.state();
  if (control != control_) {
    constexpr std::uint16_t kOn = control_bit::kSwitchOn | control_bit::kEnableOperation;
    machine_.take_control(without_mains_ ? control & ~kOn : control);
    take_set_point(control);
  }
  control_ = control;
  if (before == machine_.state()) return;
  if (before == PowerState::kFault) {
    set(object::kErrorCode, 0);
    device_.clear_error();
  }
  if (machine_.state() == PowerState::kOperationEnabled) {
    loops_.reset();
    demand_ = {axis_.position(), axis_.velocity()};
    set_point_ = cycle_target_ = axis_.position();
  }
  write_actual();
}

void EmulatedDrive::change_mode(Mode mode) {
  mode_ = mode;
  homing_ = homed_ = homing_failed_ = false;
  demand_ = {axis_.position(), axis_.velocity()};
  set_point_ = cycle_target_ = axis_.position();
  acknowledged_ = false;
}

void EmulatedDrive::take_set_point(std::uint16_t control) {
  const bool bit = (control & control_bit::kModeSpecific) != 0;
  const bool rises = bit && (control_ & control_bit::kModeSpecific) == 0;
  if (mode_ == Mode::kProfilePosition) {
    acknowledged_ = bit;
    if (!rises) return;
    const double target = scaling_.position(number(object::kTargetPosition));
    const bool relative = (control & control_bit::kRelative) != 0;
    set_point_ = relative ? set_point_ + target : target - offset_;
  }
  if (mode_ != Mode::kHoming) return;
  if (rises && machine_.state() == PowerState::kOperationEnabled) {
    found_mark_ = homed_ = homing_failed_ = false;
    homing_ = true;
    turn_.reset();
  }
  if (!bit) homing_ = false;
}

void EmulatedDrive::fail(std::uint16_t code) {
  if (machine_.state() == PowerState::kFault) return;
  machine_.fail();
  set(object::kErrorCode, code);
  device_.report(code, canopen::error_register::kProfile);
  write_actual();
}

void EmulatedDrive::watch(base::Time now) {
  const base::Duration period{number({0x1006, 0}) * 1000};
  device_.set_sync_timeout(period * kSyncsToMiss);
  if (machine_.state() != PowerState::kOperationEnabled) return;
  if (is_cyclic(mode_) && device_.sync_missing(now)) fail(canopen::emergency_code::kSyncLost);
  if (device_.state() != canopen::NmtState::kOperational) lose_host(kStoppedByMaster);
  if (device_.lost_node()) lose_host(canopen::emergency_code::kHeartbeatLost);
  const bool positioned = mode_ == Mode::kCyclicPosition || mode_ == Mode::kProfilePosition;
  const double window = scaling_.position(number(object::kFollowingErrorWindow));
  if (positioned && std::abs(demand_.position - axis_.position()) > window) {
    fail(canopen::emergency_code::kFollowingError);
  }
}

void EmulatedDrive::lose_host(std::uint16_t code) {
  switch (number(object::kAbortConnection)) {
    case 0:
      return;
    case 2:
      return machine_.take_control(encode_command(PowerCommand::kDisableVoltage));
    case 3:
      return machine_.take_control(encode_command(PowerCommand::kQuickStop));
    default:
      return fail(code);
  }
}

void EmulatedDrive::step(base::Time now) {
  const PowerState state = machine_.state();
  const bool stops =
      state == PowerState::kQuickStopActive || state == PowerState::kFaultReactionActive;
  if (stops && !stopping_) {
    stopping_since_ = now;
    demand_ = {axis_.position(), axis_.velocity()};
    homing_ = false;
  }
  stopping_ = stops;
  if (state == PowerState::kOperationEnabled) {
    axis_.step(torque_in_operation(), kStep);
  } else if (stops) {
    axis_.step(stop_torque(), kStep);
    const bool standing = std::abs(axis_.velocity()) < kStanding && demand_.velocity == 0.0;
    if (standing || now - stopping_since_ > kMostStopping) machine_.standing();
  } else if (config_.brake) {
    axis_.hold();
  } else {
    axis_.step(0.0, kStep);
  }
  warm();
}

/// With the square of its torque, as its winding; to 85 °C in the end at the most that it can give.
void EmulatedDrive::warm() {
  constexpr double kMostRise = 60.0;       // [K]
  constexpr double kTimeConstant = 120.0;  // [s]
  const double part = axis_.torque() / axis_.config().most_torque;
  const double settled = kAmbient + kMostRise * part * part;
  const double by = std::chrono::duration<double>(kStep).count();
  temperature_ += (settled - temperature_) * by / kTimeConstant;
}

double EmulatedDrive::stop_torque() {
  const Profile profile{.velocity = 1.0, .acceleration = speed(object::kQuickStopDeceleration)};
  profile.step_to_velocity(demand_, 0.0, kStep);
  return loops_.follow_position(demand_, axis_, kStep);
}

double EmulatedDrive::torque_in_operation() {
  const double most = powerless_ ? 0.0 : scaling_.torque(number(object::kMostTorque));
  return std::clamp(torque_of_mode(), -most, most);
}

double EmulatedDrive::torque_of_mode() {
  const Profile profile{.velocity = speed(object::kProfileVelocity),
                        .acceleration = speed(object::kProfileAcceleration)};
  const bool halted = (control_ & control_bit::kHalt) != 0;
  const Mode mode = halted && mode_ != Mode::kCyclicTorque ? Mode::kNone : mode_;
  switch (mode) {
    case Mode::kCyclicTorque:
      return halted ? 0.0 : scaling_.torque(number(object::kTargetTorque));
    case Mode::kCyclicVelocity:
      demand_ = {axis_.position(), scaling_.velocity(number(object::kTargetVelocity))};
      return loops_.follow_velocity(demand_.velocity, axis_, kStep);
    case Mode::kCyclicPosition: {
      const double left = cycle_target_ - demand_.position;
      const double most = demand_.velocity * std::chrono::duration<double>(kStep).count();
      const bool arrives = std::abs(left) <= std::abs(most);
      demand_.position = arrives ? cycle_target_ : demand_.position + most;
      return loops_.follow_position(demand_, axis_, kStep);
    }
    case Mode::kProfilePosition:
      profile.step_to_position(demand_, set_point_, kStep);
      return loops_.follow_position(demand_, axis_, kStep);
    case Mode::kProfileVelocity:
      profile.step_to_velocity(demand_, scaling_.velocity(number(object::kTargetVelocity)), kStep);
      return loops_.follow_position(demand_, axis_, kStep);
    case Mode::kHoming:
      home();
      return loops_.follow_position(demand_, axis_, kStep);
    case Mode::kNone:
      profile.step_to_velocity(demand_, 0.0, kStep);
      return loops_.follow_position(demand_, axis_, kStep);
  }
  return 0.0;
}

void EmulatedDrive::home() {
  const Profile profile{.velocity = speed(object::kHomingSpeed),
                        .acceleration = speed(object::kHomingAcceleration)};
  const auto method = find_homing_method(static_cast<std::int8_t>(number(object::kHomingMethod)));
  if (!homing_ || !method) {
    profile.step_to_velocity(demand_, 0.0, kStep);
    return;
  }
  if (method->mark == HomingMark::kHere) return finish_homing(axis_.position());
  const bool negative = method->first == HomingDirection::kNegative;
  const double sign = negative ? -1.0 : 1.0;
  if (method->mark == HomingMark::kNothing) return find_index(sign);
  const bool at_switch = negative ? axis_.at_low_switch() : axis_.at_high_switch();
  if (!found_mark_) profile.step_to_velocity(demand_, sign * profile.velocity, kStep);
  if (at_switch && !method->with_index) {
    return finish_homing(negative ? axis_.config().low : axis_.config().high);
  }
  found_mark_ = found_mark_ || at_switch;
  if (at_switch) turn_.reset();  // indices count behind its edge
  if (found_mark_) find_index(-sign);
}

/// The encoder at the motor has one a turn.
void EmulatedDrive::find_index(double sign) {
  const Profile profile{.velocity = speed(object::kHomingSlowSpeed),
                        .acceleration = speed(object::kHomingAcceleration)};
  profile.step_to_velocity(demand_, sign * profile.velocity, kStep);
  const double pitch =
      2.0 * std::numbers::pi * config_.factors.gear_shaft / config_.factors.gear_motor;
  const double turn = std::floor(axis_.position() / pitch);
  const double before = turn_.value_or(turn);
  turn_ = turn;
  if (turn != before) finish_homing(std::max(turn, before) * pitch);
}

void EmulatedDrive::finish_homing(double position) {
  offset_ = scaling_.position(number(object::kHomeOffset)) - position;
  homing_ = false;
  homed_ = true;
}

std::uint16_t EmulatedDrive::mode_bits() const {
  std::uint16_t bits = 0;
  const auto set_if = [&bits](bool set, std::uint16_t bit) {
    if (set) bits = static_cast<std::uint16_t>(bits | bit);
  };
  const bool enabled = machine_.state() == PowerState::kOperationEnabled;
  const bool stands = std::abs(axis_.velocity()) < kStanding;
  const bool halted = (control_ & control_bit::kHalt) != 0;
  switch (mode_) {
    case Mode::kProfilePosition:
      set_if(acknowledged_, status_bit::kAcknowledge);
      set_if(halted ? stands : stands && std::abs(set_point_ - axis_.position()) < kReached,
             status_bit::kTargetReached);
      break;
    case Mode::kProfileVelocity:
      set_if(std::abs(demand_.velocity - axis_.velocity()) < kStanding, status_bit::kTargetReached);
      break;
    case Mode::kHoming:
      set_if(homed_, status_bit::kAcknowledge);
      set_if(homing_failed_, status_bit::kFollowingError);
      set_if(stands && !homing_, status_bit::kTargetReached);
      break;
    case Mode::kCyclicPosition:
    case Mode::kCyclicVelocity:
    case Mode::kCyclicTorque:
      set_if(enabled && !halted, status_bit::kFollowsCommand);
      break;
    case Mode::kNone:
      break;
  }
  return bits;
}

void EmulatedDrive::write_actual() {
  if (frozen_) return;
  const double torque = axis_.torque();
  const bool limited = std::abs(torque) >= axis_.config().most_torque;
  std::uint16_t status =
      static_cast<std::uint16_t>(encode_state(machine_.state()) | mode_bits() |
                                 status_bit::kVoltageEnabled | status_bit::kRemote);
  if (limited) status = static_cast<std::uint16_t>(status | status_bit::kInternalLimit);
  set(object::kStatusWord, status);
  set(object::kModeDisplay, static_cast<int>(mode_));
  set(object::kPosition, scaling_.raw_position(axis_.position() + offset_));
  set(object::kPositionDemand, scaling_.raw_position(demand_.position + offset_));
  set(object::kVelocity, scaling_.raw_velocity(axis_.velocity()));
  const std::int16_t raw_torque = scaling_.raw_torque(torque);
  set(object::kTorque, raw_torque);
  set(object::kCurrent, raw_torque);
  set(object::kEmulatedTemperature, std::lround(10.0 * temperature_));
}

}  // namespace armature::cia402
