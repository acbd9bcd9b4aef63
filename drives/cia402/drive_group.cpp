// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/drive_group.hpp"

#include <utility>

#include "armature/base/seconds.hpp"
#include "drives/canopen/little_endian.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using canopen::Address;
using canopen::Pdo;

std::optional<Address> target_of(Mode mode) {
  switch (mode) {
    case Mode::kCyclicPosition:
      return object::kTargetPosition;
    case Mode::kCyclicVelocity:
      return object::kTargetVelocity;
    case Mode::kCyclicTorque:
      return object::kTargetTorque;
    default:
      return std::nullopt;
  }
}

base::Error lacks(const DriveConfig& config, const char* direction, Address address,
                  const char* what) {
  return base::Error{"drive '" + config.name + "', node " + std::to_string(config.node) + ": no " +
                     direction + " has " + to_text(address) + ", " + what + " (map it)"};
}

std::vector<std::vector<std::uint64_t>> values_for(const std::vector<Pdo>& pdos) {
  std::vector<std::vector<std::uint64_t>> values;
  for (const Pdo& pdo : pdos) values.emplace_back(pdo.objects.size());
  return values;
}

}  // namespace

std::optional<DriveGroup::Place> DriveGroup::find(const std::vector<Pdo>& pdos, Address address) {
  for (std::size_t pdo = 0; pdo < pdos.size(); ++pdo) {
    for (std::size_t i = 0; i < pdos[pdo].objects.size(); ++i) {
      if (pdos[pdo].objects[i].address == address) return Place{pdo, i};
    }
  }
  return std::nullopt;
}

base::Result<DriveGroup::Drive> DriveGroup::make_drive(DriveConfig config) {
  const auto target_address = target_of(config.mode);
  if (!target_address) {
    return base::Error{"drive '" + config.name + "' has mode " + to_text(config.mode) +
                       ", expected CSP, CSV or CST"};
  }
  for (const auto* pdos : {&config.receive, &config.transmit}) {
    for (const Pdo& pdo : *pdos) {
      if (const auto checked = canopen::check_mapping(pdo.objects); !checked) {
        return base::Error{"drive '" + config.name + "': " + checked.error()};
      }
    }
  }
  const auto control = find(config.receive, object::kControlWord);
  if (!control) return lacks(config, "RPDO", object::kControlWord, "the control word");
  const auto target = find(config.receive, *target_address);
  if (!target) return lacks(config, "RPDO", *target_address, "the target of its mode");
  const auto status = find(config.transmit, object::kStatusWord);
  if (!status) return lacks(config, "TPDO", object::kStatusWord, "the status word");
  const auto position = find(config.transmit, object::kPosition);
  if (!position) return lacks(config, "TPDO", object::kPosition, "the position");
  Drive drive;
  drive.control = *control;
  drive.target = *target;
  drive.status = *status;
  drive.position = *position;
  drive.mode = find(config.receive, object::kMode);
  drive.velocity = find(config.transmit, object::kVelocity);
  drive.torque = find(config.transmit, object::kTorque);
  drive.error_code = find(config.transmit, object::kErrorCode);
  drive.sent = values_for(config.receive);
  drive.received = values_for(config.transmit);
  drive.told_mode = config.mode;
  drive.config = std::move(config);
  return drive;
}

base::Result<DriveGroup> DriveGroup::make(std::vector<DriveConfig> drives,
                                          std::uint8_t sync_overflow) {
  DriveGroup group(sync_overflow);
  for (DriveConfig& config : drives) {
    for (const Drive& other : group.drives_) {
      if (other.config.node != config.node) continue;
      return base::Error{"drives '" + other.config.name + "' and '" + config.name +
                         "' both have node " + std::to_string(config.node) +
                         " (give each its own)"};
    }
    if (config.heartbeat_timeout > base::Duration{}) {
      group.heartbeats_.watch(config.node, config.heartbeat_timeout);
    }
    auto drive = make_drive(std::move(config));
    if (!drive) return base::Error{drive.error()};
    group.drives_.push_back(std::move(drive).value());
  }
  return group;
}

void DriveGroup::set_heartbeat(canopen::NodeId node, base::Duration period, base::Time now) {
  heartbeat_ = canopen::HeartbeatProducer(node);
  heartbeat_.set_period(period, now);
}

void DriveGroup::take(const can::Arrival& arrival) noexcept {
  heartbeats_.take(arrival.frame, arrival.time);
  const auto emergency = canopen::parse_emergency(arrival.frame);
  for (Drive& drive : drives_) {
    if (emergency && emergency->node == drive.config.node) {
      drive.state.emergency = emergency;
      if (emergency->code == canopen::emergency_code::kNoError) drive.state.emergency.reset();
    }
    for (std::size_t pdo = 0; pdo < drive.config.transmit.size(); ++pdo) {
      if (unpack(drive.config.transmit[pdo], arrival.frame, drive.received[pdo])) {
        use(drive, pdo, arrival.time);
      }
    }
  }
}

void DriveGroup::use(Drive& drive, std::size_t pdo, base::Time time) noexcept {
  DriveState& state = drive.state;
  const Scaling& scaling = drive.config.scaling;
  const auto number = [&](const Place& place, unsigned bits) {
    return canopen::sign_extended(drive.received[place.pdo][place.object], bits);
  };
  drive.answered = true;
  if (drive.status.pdo == pdo) {
    state.status = static_cast<std::uint16_t>(number(drive.status, 16));
    state.power = decode_status(state.status);
  }
  if (drive.position.pdo == pdo) {
    const double position = scaling.position(number(drive.position, 32));
    if (!drive.velocity && time > state.time && state.time > base::Time{}) {
      state.velocity = (position - state.position) / base::to_seconds(time - state.time);
    }
    state.position = position;
    state.time = time;
  }
  if (drive.velocity && drive.velocity->pdo == pdo) {
    state.velocity = scaling.velocity(number(*drive.velocity, 32));
  }
  if (drive.torque && drive.torque->pdo == pdo) {
    state.effort = scaling.torque(number(*drive.torque, 16));
  }
  if (drive.error_code && drive.error_code->pdo == pdo) {
    state.error_code = static_cast<std::uint16_t>(number(*drive.error_code, 16));
  }
}

void DriveGroup::set_goal(std::size_t drive, PowerGoal goal) noexcept {
  drives_[drive].power.set_goal(goal);
}

void DriveGroup::ask_reset(std::size_t drive) noexcept { drives_[drive].power.ask_reset(); }

void DriveGroup::set_halt(std::size_t drive, bool halt) noexcept { drives_[drive].halt = halt; }

void DriveGroup::set_mode(std::size_t drive, Mode mode, bool start) noexcept {
  drives_[drive].told_mode = mode;
  drives_[drive].start = start;
}

void DriveGroup::set_target(std::size_t drive, double target) noexcept {
  if (drives_[drive].state.enabled()) drives_[drive].wanted = target;
}

void DriveGroup::watch(Drive& drive) noexcept {
  const auto& heard = heartbeats_.node(drive.config.node);
  drive.state.presence = heard.presence;
  drive.state.reboots += heard.boot_ups - drive.boot_ups;
  const bool rebooted = heard.boot_ups != drive.boot_ups;
  drive.boot_ups = heard.boot_ups;
  if (!drive.answered) ++drive.state.silent_cycles;
  if (drive.answered) drive.state.silent_cycles = 0;
  drive.answered = false;
  const bool silent = drive.state.silent_cycles > drive.config.most_silent_cycles;
  const bool lost = heard.presence == canopen::Presence::kLost;
  if ((silent || lost) && drive.power.goal() != PowerGoal::kOff) {
    drive.power.set_goal(PowerGoal::kQuickStop);
  }
  if (!rebooted) return;
  drive.power.set_goal(PowerGoal::kOff);
  drive.state.power.reset();  // until it tells
}

void DriveGroup::fill(Drive& drive) noexcept {
  const Scaling& scaling = drive.config.scaling;
  if (!drive.state.enabled()) {
    const bool positioned = drive.config.mode == Mode::kCyclicPosition;
    drive.wanted = positioned ? drive.state.position : 0.0;
  }
  std::uint16_t control = drive.power.step(drive.state.power);
  if (drive.halt) control = static_cast<std::uint16_t>(control | control_bit::kHalt);
  if (drive.start && drive.state.enabled()) {
    control = static_cast<std::uint16_t>(control | control_bit::kModeSpecific);
  }
  const std::int32_t target = drive.config.mode == Mode::kCyclicTorque
                                  ? scaling.raw_torque(drive.wanted)
                                  : scaling.raw_position(drive.wanted);
  drive.sent[drive.control.pdo][drive.control.object] = control;
  drive.sent[drive.target.pdo][drive.target.object] = static_cast<std::uint64_t>(target);
  if (drive.mode) {
    drive.sent[drive.mode->pdo][drive.mode->object] = static_cast<std::uint64_t>(drive.told_mode);
  }
}

std::size_t DriveGroup::step(can::Bus& bus, base::Time now) noexcept {
  std::size_t refused = 0;
  const auto send = [&](const can::Frame& frame) {
    if (bus.send(frame) != can::SendStatus::kSent) ++refused;
  };
  heartbeats_.check(now);
  for (Drive& drive : drives_) {
    watch(drive);
    fill(drive);
    for (std::size_t pdo = 0; pdo < drive.config.receive.size(); ++pdo) {
      send(pack(drive.config.receive[pdo], drive.sent[pdo]));
    }
  }
  send(sync_.step());
  if (const auto heartbeat = heartbeat_.step(canopen::NmtState::kOperational, now)) {
    send(*heartbeat);
  }
  return refused;
}

}  // namespace armature::cia402
