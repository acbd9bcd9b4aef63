// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/safety_board.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace armature::wam {
namespace {

/// Boards with older firmware do not let the host set MODE.
constexpr int kFirstWithMode = 197;
constexpr double kSpeedUnit = 4096.0;  // of VL1 and VL2, for 1 m/s

constexpr std::int32_t to_value(BoardMode mode) { return static_cast<std::int32_t>(mode); }

}  // namespace

SafetyBoard::SafetyBoard(const Config& config, can::VirtualBus& bus)
    : config_(config),
      bus_(bus),
      station_(bus.add_station("safety", can::SendOrder::kMostUrgent)),
      store_(PuckKind::kSafety, config.version),
      tip_speed_(config.counts_per_turn) {
  levels_.fill(Level::kSafe);
  store_.set_default(Property::kVers, config.version);
  store_.set_default(Property::kRole, kSafetyRole);
  store_.set_default(Property::kId, kBoardNode);
  store_.set_default(Property::kStat, static_cast<int>(PuckStatus::kReady));
  store_.set_default(Property::kGrpa, 1);
  store_.set_default(Property::kGrpb, 2);
  store_.set_default(Property::kGrpc, 3);
  store_.set_default(Property::kVl1, 2048);
  store_.set_default(Property::kVl2, 4096);
  store_.set_default(Property::kTl1, 4731);
  store_.set_default(Property::kTl2, 5204);
  store_.set_default(Property::kVoltl1, 36);
  store_.set_default(Property::kVoltl2, 30);
  store_.set_default(Property::kVolth1, 54);
  store_.set_default(Property::kVolth2, 57);
}

bool SafetyBoard::switch_on(base::Diagnostics& diagnostics) {
  can::BusOptions options;
  options.on_news = [this] { take_news(); };
  return station_.open(options, diagnostics);
}

// ---- Keys

void SafetyBoard::estop() {
  button_pressed_ = true;
  enter_estop();
}

void SafetyBoard::shift_idle() {
  press(PendantKey::kIdle);
  if (button_pressed_) return;
  levels_.fill(Level::kSafe);
  overspeed_until_ = base::Time::max();
  enter_idle();
  judge_supply();
}

void SafetyBoard::shift_activate() {
  press(PendantKey::kActivate);
  if (mode() == BoardMode::kIdle && !has_fault()) enter_active();
}

void SafetyBoard::press(PendantKey key) {
  key_ = key;
  key_until_ = bus_.now() + config_.key_time;
}

PendantWord SafetyBoard::pendant() const {
  PendantWord word;
  word.key = mode() == BoardMode::kEstop ? PendantKey::kEstop : key_;
  word.activate_lamp = mode() == BoardMode::kActive;
  word.idle_lamp = mode() == BoardMode::kIdle;
  word.display = mode() == BoardMode::kEstop ? 'E' : '0';
  word.levels = levels_;
  return word;
}

// ---- Modes

void SafetyBoard::enter_estop() {
  store_.set(Property::kMode, to_value(BoardMode::kEstop));
  store_.set(Property::kZero, 0);
  armed_ = false;
  overspeed_until_ = base::Time::max();
  tip_speed_.forget();
}

void SafetyBoard::enter_idle() {
  if (mode() == BoardMode::kActive) tell_motor_modes(PuckMode::kIdle);
  store_.set(Property::kMode, to_value(BoardMode::kIdle));
}

void SafetyBoard::enter_active() {
  store_.set(Property::kMode, to_value(BoardMode::kActive));
  armed_ = true;
  feed_heartbeat();
  tell_motor_modes(PuckMode::kTorque);
}

void SafetyBoard::tell_motor_modes(PuckMode mode) {
  const Address everybody{kBoardNode, static_cast<int>(Group::kAll), true};
  send(set_frame(everybody, store_.number(Property::kMode), static_cast<int>(mode),
                 config_.broadcasts),
       bus_.now());
}

// ---- Frames

void SafetyBoard::take_news() {
  can::Arrival arrival;
  while (station_.receive(arrival) == can::ReceiveStatus::kReceived) take(arrival.frame);
  if (station_.state() == can::BusState::kBusOff) station_.restart();
}

void SafetyBoard::take(const can::Frame& frame) {
  const std::optional<Address> address = address_of(frame);
  if (!address) return;
  if (!address->group) {
    if (address->to != kBoardNode) return;
    const std::optional<Message> message = parse_message(frame);
    return message ? take_message(*message) : static_cast<void>(++counters_.ignored);
  }
  const auto group = static_cast<Group>(address->to);
  if (group == Group::kPositions) take_positions(address->from, frame);
  if (group == Group::kLowerArm || group == Group::kWrist) {
    // Which property is T depends on the pucks; a frame of eight bytes to these groups is torques.
    const auto torques = parse_torques(frame, frame.data[0] & 0x7f);
    if (torques) take_torques(*torques);
  }
}

void SafetyBoard::take_message(const Message& message) {
  const std::optional<Property> property = store_.property(message.number);
  if (!property) {
    ++counters_.ignored;
  } else if (message.set) {
    set(*property, message.value);
  } else {
    answer(*property);
  }
}

void SafetyBoard::set(Property property, std::int32_t value) {
  switch (property) {
    case Property::kMode:
      return set_mode(value);
    case Property::kVers:
    case Property::kRole:
    case Property::kId:
    case Property::kStat:
    case Property::kPen:
      ++counters_.ignored;
      return;
    default:
      if (!store_.execute(property, value)) store_.set(property, value);
  }
}

/// The host may lower the mode, never raise it.
void SafetyBoard::set_mode(std::int32_t mode) {
  if (config_.version < kFirstWithMode || mode > to_value(this->mode()) || mode < 0) {
    ++counters_.refused;
  } else if (mode == to_value(BoardMode::kEstop)) {
    enter_estop();
  } else if (mode == to_value(BoardMode::kIdle)) {
    enter_idle();
  }
}

void SafetyBoard::answer(Property property) {
  if (replies_to_lose_ > 0) {
    --replies_to_lose_;
    return;
  }
  const bool is_pendant = property == Property::kPen;
  const std::int32_t value = is_pendant ? pendant_value(pendant()) : store_.get(property);
  const Width width =
      config_.replies == ReplyWidth::kAlwaysSix ? Width::kFour : store_.width(property);
  send(reply_frame(kBoardNode, store_.number(property), value, width),
       bus_.now() + config_.reply_delay + late_by_);
}

void SafetyBoard::send(const can::Frame& frame, base::Time at) {
  if (station_.send_at(frame, at) != can::SendStatus::kSent) ++counters_.not_sent;
}

// ---- Supervision

void SafetyBoard::fail(Monitor monitor) { trip(monitor); }

void SafetyBoard::set_supply(double volts) {
  supply_ = volts;
  judge_supply();
}

void SafetyBoard::judge_supply() {
  if (supply_ < store_.get(Property::kVoltl2) || supply_ > store_.get(Property::kVolth2)) {
    return trip(Monitor::kVoltage);
  }
  warn(Monitor::kVoltage,
       supply_ < store_.get(Property::kVoltl1) || supply_ > store_.get(Property::kVolth1));
}

void SafetyBoard::take_positions(int node, const can::Frame& frame) {
  const std::optional<Positions> positions = parse_positions(frame);
  if (!positions || node < 1 || node > static_cast<int>(kMostMotors)) return;
  feed_heartbeat();
  if (node > static_cast<int>(TipSpeed::kMotors)) return;
  const auto speed =
      tip_speed_.add(static_cast<std::size_t>(node - 1), positions->motor, bus_.now(), zeroed());
  if (speed) judge_speed(*speed);
}

void SafetyBoard::judge_speed(double speed) {
  const std::int32_t ignored = store_.get(Property::kIfault);
  if (ignored > 0) return store_.set(Property::kIfault, ignored - 1);
  const std::int32_t most = store_.get(Property::kVl2);
  overspeed_ = most > 0 && speed * kSpeedUnit > most;
  if (overspeed_ && level(Monitor::kVelocity) != Level::kFault) {
    overspeed_until_ = bus_.now() + config_.overspeed_time;
    return trip(Monitor::kVelocity);
  }
  if (!overspeed_) overspeed_until_ = base::Time::max();
  warn(Monitor::kVelocity, speed * kSpeedUnit > store_.get(Property::kVl1));
}

void SafetyBoard::take_torques(const Torques& torques) {
  feed_heartbeat();
  if (mode() != BoardMode::kActive) return;
  int most = 0;
  for (const std::int16_t torque : torques) most = std::max(most, std::abs(int{torque}));
  if (most > store_.get(Property::kTl2)) return trip(Monitor::kTorque);
  warn(Monitor::kTorque, most > store_.get(Property::kTl1));
}

void SafetyBoard::warn(Monitor monitor, bool warned) {
  if (level(monitor) == Level::kFault) return;
  level(monitor) = warned ? Level::kWarning : Level::kSafe;
}

void SafetyBoard::trip(Monitor monitor) {
  level(monitor) = Level::kFault;
  if (mode() == BoardMode::kActive) enter_idle();
}

bool SafetyBoard::has_fault() const {
  return std::ranges::find(levels_, Level::kFault) != levels_.end();
}

base::Time SafetyBoard::next_deadline() const {
  const base::Time heartbeat =
      armed_ ? base::later(fed_, config_.heartbeat_timeout) : base::Time::max();
  return std::min({heartbeat, key_until_, overspeed_until_});
}

void SafetyBoard::run_timers() {
  const base::Time now = bus_.now();
  if (armed_ && now >= fed_ + config_.heartbeat_timeout) {
    armed_ = false;
    trip(Monitor::kHeartbeat);
  }
  if (now >= key_until_) {
    key_ = PendantKey::kNone;
    key_until_ = base::Time::max();
  }
  if (now >= overspeed_until_) {
    overspeed_until_ = base::Time::max();
    enter_estop();
  }
}

}  // namespace armature::wam
