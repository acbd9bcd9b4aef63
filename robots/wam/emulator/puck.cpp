// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/puck.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace armature::wam {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::array<std::int32_t, kMostMotors> kUnitsPerNm{2700, 2700, 2700, 2700,
                                                            6500, 6500, 17474};
constexpr std::array<std::int32_t, kMostMotors> kMostTorques{4860, 4860, 4860, 4320,
                                                             3900, 3900, 1600};
constexpr int kLastOfLowerArm = 4;

std::int32_t rounded_down(double counts) { return static_cast<std::int32_t>(std::floor(counts)); }

}  // namespace

Puck::Config Puck::standard(int node, int version) {
  Config config;
  const auto motor = static_cast<std::size_t>(node - 1);
  const bool wrist = node > kLastOfLowerArm;
  config.node = node;
  config.version = version;
  config.units_per_nm = kUnitsPerNm[motor];
  config.most_torque = kMostTorques[motor];
  config.slot = wrist ? node - kLastOfLowerArm : node;
  config.groups = {0, wrist ? 2 : 1, 4};
  config.poles = node == 7 ? 6 : 12;  // which tells the wrist from the gimbals
  return config;
}

Puck::Puck(const Config& config, can::VirtualBus& bus, Motors& motors, std::size_t motor)
    : config_(config),
      bus_(bus),
      motors_(motors),
      motor_(motor),
      station_(bus.add_station("puck" + std::to_string(config.node), can::SendOrder::kMostUrgent)),
      store_(PuckKind::kMotor, config.version),
      monitor_(PuckKind::kMonitor, config.monitor_version) {
  for (PropertyStore* store : {&store_, &monitor_}) {
    store->set_default(Property::kRole, config.role);
    store->set_default(Property::kId, config.node);
  }
  monitor_.set_default(Property::kVers, config.monitor_version);
  monitor_.set_default(Property::kStat, static_cast<int>(PuckStatus::kReset));
  store_.set_default(Property::kVers, config.told_version.value_or(config.version));
  store_.set_default(Property::kStat, static_cast<int>(PuckStatus::kReady));
  store_.set_default(Property::kCts, config.counts_per_turn);
  store_.set_default(Property::kIpnm, config.units_per_nm);
  store_.set_default(Property::kMt, config.most_torque);
  store_.set_default(Property::kPidx, config.slot);
  store_.set_default(Property::kPoles, config.poles);
  store_.set_default(Property::kTemp, config.temperature);
  store_.set_default(Property::kTherm, config.motor_temperature);
  store_.set_default(Property::kGrpa, config.groups[0]);
  store_.set_default(Property::kGrpb, config.groups[1]);
  store_.set_default(Property::kGrpc, config.groups[2]);
}

// ---- Power

void Puck::set_power(bool on) {
  if (on == (state_ != PuckState::kOff)) return;
  state_ = on ? PuckState::kBooting : PuckState::kOff;
  due_ = on ? bus_.now() + config_.boot_time : base::Time::max();
  if (!on) return_to_monitor();
}

base::Time Puck::next_deadline() const {
  const bool has_left = station_.state() == can::BusState::kClosed;
  return has_left || on_bus() ? due_ : bus_.now();
}

/// A station cannot leave its bus while the bus tells it something, so it leaves here.
void Puck::run_timers() {
  if (!on_bus()) station_.close();
  if (bus_.now() < due_) return;
  due_ = base::Time::max();
  if (state_ == PuckState::kBooting) {
    boot();
  } else if (state_ == PuckState::kWaking) {
    start_main();
  }
}

void Puck::join_bus() {
  can::BusOptions options;
  options.on_news = [this] { take_news(); };
  base::Diagnostics diagnostics;
  static_cast<void>(station_.open(options, diagnostics));  // closed, and the options are good
}

/// Where the encoder begins to count is not known of real pucks; a turn's absolute position is all
/// that they can know.
void Puck::boot() {
  state_ = PuckState::kMonitor;
  motors_.advance_to(bus_.now());
  offset_ = mech() - encoder();
  join_bus();
}

void Puck::start_main() {
  state_ = PuckState::kReady;
  store_.power_on();
  join_bus();
}

void Puck::return_to_monitor() {
  motors_.advance_to(bus_.now());
  set_mode(static_cast<int>(PuckMode::kIdle));
}

// ---- Frames

void Puck::take_news() {
  can::Arrival arrival;
  while (station_.receive(arrival) == can::ReceiveStatus::kReceived) {
    if (on_bus()) take(arrival.frame);
  }
  if (station_.state() == can::BusState::kBusOff) station_.restart();
}

void Puck::take(const can::Frame& frame) {
  const std::optional<Address> address = address_of(frame);
  if (!address || !is_for_me(*address)) return;
  motors_.advance_to(bus_.now());
  const bool ready = state_ == PuckState::kReady;
  if (const auto torques = parse_torques(frame, store_.number(Property::kT)); torques && ready) {
    return set_torque(
        (*torques)[static_cast<std::size_t>(store_.get(Property::kPidx) - 1) % kTorquesPerFrame]);
  }
  const std::optional<Message> message = parse_message(frame);
  if (!message) return ignore();
  if (message->set) {
    ready ? set(*message) : set_in_monitor(*message);
  } else {
    ready ? get(message->number) : get_in_monitor(message->number);
  }
}

/// The monitor knows no groups but that of all.
bool Puck::is_for_me(const Address& address) const {
  if (!address.group) return address.to == config_.node;
  if (state_ == PuckState::kMonitor) return address.to == static_cast<int>(Group::kAll);
  return address.to == store_.get(Property::kGrpa) || address.to == store_.get(Property::kGrpb) ||
         address.to == store_.get(Property::kGrpc);
}

void Puck::get_in_monitor(int number) {
  const std::optional<Property> property = monitor_.property(number);
  if (!property) return ignore();
  reply(number, monitor_.get(*property), monitor_.width(*property));
}

void Puck::get(int number) {
  const std::optional<Property> property = store_.property(number);
  if (!property) return ignore();
  if (*property == Property::kP) {
    return answer(position_frame(config_.node, positions(), config_.position_flags));
  }
  if (*property == Property::kJp && positions().joint) {
    return answer(joint_position_frame(config_.node, *positions().joint, config_.position_flags));
  }
  reply(number, value(*property), store_.width(*property));
}

/// A motor's torque is as its current, and T is nearly that in milliamperes: which units IMOTOR has
/// nobody says.
std::int32_t Puck::value(Property property) const {
  if (property == Property::kMech) return mech();
  return store_.get(property == Property::kImotor ? Property::kT : property);
}

void Puck::set_in_monitor(const Message& message) {
  if (message.number != monitor_.number(Property::kStat) ||
      message.value != static_cast<int>(PuckStatus::kReady)) {
    return ignore();
  }
  state_ = PuckState::kWaking;
  due_ = bus_.now() + config_.wake_time;
}

void Puck::set(const Message& message) {
  const std::optional<Property> property = store_.property(message.number);
  if (!property) return ignore();
  set_property(*property, message.value);
}

void Puck::set_property(Property property, std::int32_t value) {
  switch (property) {
    case Property::kVers:
    case Property::kRole:
    case Property::kId:
    case Property::kMech:
    case Property::kTemp:
    case Property::kTherm:
    case Property::kImotor:
      return ignore();  // written by the maker alone
    case Property::kStat:
      if (value != static_cast<int>(PuckStatus::kReset)) return;
      return_to_monitor();
      state_ = PuckState::kMonitor;
      return;
    case Property::kP:
      offset_ = std::int64_t{value} - encoder();
      return;
    case Property::kMode:
      return set_mode(value);
    case Property::kT:
      return set_torque(value);
    default:
      if (!store_.execute(property, value)) store_.set(property, value);
  }
}

/// A motor that was told nothing in its mode drives nothing.
void Puck::set_mode(std::int32_t mode) {
  if (mode < static_cast<int>(PuckMode::kIdle) || mode > static_cast<int>(PuckMode::kTrapezoidal)) {
    return ignore();
  }
  store_.set(Property::kMode, mode);
  store_.set(Property::kT, 0);
  if (mode == static_cast<int>(PuckMode::kIdle)) {
    motors_.brake(motor_);
  } else {
    motors_.drive(motor_, 0.0);
  }
}

void Puck::set_torque(std::int32_t units) {
  if (mode() != PuckMode::kTorque) return;
  const std::int32_t most = std::max(store_.get(Property::kMt), 0);
  store_.set(Property::kT, std::clamp(units, -most, most));
  motors_.drive(motor_, static_cast<double>(torque()) / config_.units_per_nm);
}

// ---- Positions

std::int32_t Puck::encoder() const {
  return rounded_down(motors_.angle(motor_) / kTurn * config_.counts_per_turn);
}

std::int32_t Puck::mech() const {
  const double turns = (motors_.angle(motor_) - config_.mech_zero) / kTurn;
  return rounded_down((turns - std::floor(turns)) * config_.counts_per_turn);
}

/// The joint's encoder counts as the motor's does: enough for a host that reads both.
Positions Puck::positions() const {
  Positions positions{counts(), std::nullopt};
  if ((config_.role & kJointEncoder) != 0) positions.joint = encoder();
  return positions;
}

// ---- Answers

void Puck::reply(int number, std::int32_t value, Width width) {
  if (config_.replies == ReplyWidth::kAlwaysSix) width = Width::kFour;
  answer(reply_frame(config_.node, number, value, width));
}

void Puck::spoil_replies(ReplySpoil how, int count) {
  spoil_ = how;
  replies_to_spoil_ = count;
}

void Puck::answer(can::Frame frame) {
  if (replies_to_lose_ > 0) {
    --replies_to_lose_;
    ++counters_.lost;
    return;
  }
  const ReplySpoil spoil = replies_to_spoil_ > 0 ? spoil_ : ReplySpoil::kNone;
  if (replies_to_spoil_ > 0) --replies_to_spoil_;
  if (spoil == ReplySpoil::kWrongProperty) ++frame.data[0];
  if (spoil == ReplySpoil::kWrongLength) --frame.size;
  if (spoil == ReplySpoil::kSecondByte) frame.data[1] = 1;
  if (spoil == ReplySpoil::kTwice) send(frame);
  send(frame);
}

void Puck::send(const can::Frame& frame) {
  const base::Time at = bus_.now() + config_.reply_delay + late_by_;
  const bool sent = station_.send_at(frame, at) == can::SendStatus::kSent;
  ++(sent ? counters_.answers : counters_.not_sent);
}

}  // namespace armature::wam
