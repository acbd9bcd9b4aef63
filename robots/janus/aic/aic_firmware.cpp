// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_firmware.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace armature::janus {
namespace {

std::uint16_t whole_seconds(base::Duration time) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(
      std::min(std::chrono::duration_cast<std::chrono::seconds>(time).count(), kMost));
}

std::int16_t milliamperes(double current) {
  constexpr double kMost = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(std::lround(std::clamp(current * 1000.0, -kMost, kMost)));
}

}  // namespace

AicFirmware::AicFirmware(int card, can::VirtualBus& bus, AicWiring& wiring)
    : card_(card),
      bus_(bus),
      wiring_(wiring),
      station_(bus.add_station("aic" + std::to_string(card), can::SendOrder::kMostUrgent)) {}

bool AicFirmware::power_on(base::Diagnostics& diagnostics) {
  can::BusOptions options;
  options.send_capacity = AicReportBook::kMost;
  options.own_frames = true;  // as the interrupt that tells that a frame was sent
  options.on_news = [this] { take_news(); };
  if (!station_.open(options, diagnostics)) return false;
  powered_ = true;
  state_ = AicState::kStarted;
  started_ = bus_.now();
  next_heartbeat_ = bus_.now();
  watchdog_ = kDefaultWatchdog;
  book_ = {};
  heartbeat_waits_ = false;
  wiring_.take_counts(bus_.now());
  run_timers();
  trip_for_lasting_faults();
  return true;
}

void AicFirmware::power_off() {
  powered_ = false;
  state_ = AicState::kStarted;
  station_.close();
  wiring_.switch_off(bus_.now());
  apply_brake();
}

base::Time AicFirmware::next_deadline() const {
  if (!powered_) return base::Time::max();
  return supervised() ? std::min(next_heartbeat_, fed_ + watchdog_) : next_heartbeat_;
}

void AicFirmware::run_timers() {
  if (!powered_) return;
  const base::Time now = bus_.now();
  if (supervised() && now >= fed_ + watchdog_) trip(AicEmergency::kWatchdog, AicState::kWatchdog);
  while (now >= next_heartbeat_) {
    if (!heartbeat_waits_) send_heartbeat(now);
    next_heartbeat_ += kHeartbeatPeriod;
  }
}

void AicFirmware::begin(AicFault fault) {
  if (fault == AicFault::kEncoderStuck && powered_) collect_counts();  // what it still saw
  faults_[static_cast<std::size_t>(fault)] = true;
  if (fault == AicFault::kSilent) station_.set_dead(true);
  if (powered_) trip_for(fault);
}

void AicFirmware::end(AicFault fault) {
  if (fault == AicFault::kEncoderStuck && powered_) collect_counts();  // what it missed is gone
  faults_[static_cast<std::size_t>(fault)] = false;
  if (fault == AicFault::kSilent) station_.set_dead(false);
}

void AicFirmware::spoil_next(AicSpoil how, int count) {
  spoil_ = how;
  spoil_left_ = count;
}

void AicFirmware::take_news() {
  can::Arrival arrival;
  while (station_.receive(arrival) == can::ReceiveStatus::kReceived) {
    if (arrival.own) {
      acknowledge(arrival.frame);
    } else {
      take(arrival.frame);
    }
  }
  if (station_.state() == can::BusState::kBusOff) come_back_from_bus_off();
}

void AicFirmware::take(const can::Frame& frame) {
  const std::optional<AicAddress> address = address_of(frame);
  if (!address) return ignore();
  const bool mine = address->number == card_;
  switch (address->function) {
    case AicFunction::kSync:
      if (frame.size != 1) return ignore();
      feed_watchdog();
      return report();
    case AicFunction::kMotorGroup:
      return address->number == group_of(card_) ? take_motor_group(frame) : void();
    case AicFunction::kCommand:
      return mine ? take_command(frame) : void();
    case AicFunction::kMotor:
      return mine ? take_motor(frame) : void();
    case AicFunction::kRequest:
      if (!mine) return;
      return frame.size == 0 ? report() : ignore();
    case AicFunction::kEmergency:
    case AicFunction::kSensor:
    case AicFunction::kHeartbeat:
      return mine ? ignore() : void();  // of another card, or of one with the same number
  }
}

void AicFirmware::take_command(const can::Frame& frame) {
  const std::optional<AicCommand> command = parse_command(frame);
  if (!command) return ignore();
  execute(*command, frame);
}

void AicFirmware::execute(AicCommand command, const can::Frame& frame) {
  switch (command) {
    case AicCommand::kActuatorOn:
      return tripped() ? refuse() : switch_on();
    case AicCommand::kActuatorOff:
      return tripped() ? acknowledge_trip() : switch_off();
    case AicCommand::kBrakeApply:
      return apply_brake();
    case AicCommand::kBrakeRelease:
      return tripped() ? refuse() : release_brake();
    case AicCommand::kWatchdog:
      if (const auto time = parse_watchdog(frame)) {
        watchdog_ = std::chrono::milliseconds(*time);
        return;
      }
      return refuse();
    case AicCommand::kIdentify:
      return send_heartbeat(answer_time());
  }
}

void AicFirmware::take_motor(const can::Frame& frame) {
  const std::optional<std::int16_t> value = parse_motor(frame);
  if (!value) return ignore();
  drive(*value);
}

void AicFirmware::take_motor_group(const can::Frame& frame) {
  const std::optional<GroupValues> values = parse_motor_group(frame);
  if (!values) return ignore();
  drive((*values)[static_cast<std::size_t>(place_in_group(card_))]);
}

/// What is off stays off: a host may send values before it switches on.
void AicFirmware::drive(std::int16_t value) {
  feed_watchdog();
  if (state_ == AicState::kOn) wiring_.drive(motor_share(value), bus_.now());
}

void AicFirmware::report() {
  const SensorReport report = latch();
  if (spoil_left_ > 0) {
    --spoil_left_;
    send_spoiled(report);
  } else {
    send_report(sensor_frame(card_, report), report.counts);
  }
}

void AicFirmware::collect_counts() {
  const std::int64_t counts = wiring_.take_counts(bus_.now());
  if (!lasts(AicFault::kEncoderStuck)) book_.add(counts);
}

SensorReport AicFirmware::latch() {
  collect_counts();
  const base::Time now = bus_.now();
  return {.counts = book_.counts(),
          .index = wiring_.index_closed(now),
          .actuator_on = state_ == AicState::kOn,
          .brake_released = brake_released_,
          .fault = state_ == AicState::kFault,
          .watchdog_tripped = state_ == AicState::kWatchdog,
          .counter = book_.counter(),
          .current_ma = milliamperes(wiring_.motor_current(now))};
}

void AicFirmware::send_spoiled(const SensorReport& report) {
  if (spoil_ == AicSpoil::kWrongCounter) book_.skip(5);
  SensorReport told = report;
  told.counter = book_.counter();
  can::Frame frame = sensor_frame(card_, told);
  if (spoil_ == AicSpoil::kWrongLength) --frame.size;
  if (spoil_ == AicSpoil::kWrongIdentifier) ++frame.id;
  if (spoil_ == AicSpoil::kTwice) send(frame, answer_time());
  send_report(frame, report.counts);
}

void AicFirmware::send_report(const can::Frame& frame, std::int32_t counts) {
  if (!send(frame, answer_time())) return;
  book_.hand_over(frame.id, counts);
  ++counters_.reports;
}

void AicFirmware::acknowledge(const can::Frame& own) {
  book_.acknowledge(own.id);
  if (own.id == identifier(AicFunction::kHeartbeat, card_)) heartbeat_waits_ = false;
}

/// The frames that waited are gone, so their counts go into the next report.
void AicFirmware::come_back_from_bus_off() {
  book_.take_back();
  heartbeat_waits_ = false;
  station_.restart();
}

void AicFirmware::switch_on() {
  if (state_ == AicState::kOn) return;
  if (!supervised()) feed_watchdog();
  state_ = AicState::kOn;
  wiring_.drive(0.0, bus_.now());
}

void AicFirmware::switch_off() {
  state_ = AicState::kOff;
  wiring_.switch_off(bus_.now());
}

void AicFirmware::acknowledge_trip() {
  state_ = AicState::kOff;
  trip_for_lasting_faults();
}

void AicFirmware::apply_brake() {
  brake_released_ = false;
  wiring_.apply_brake(bus_.now());
}

void AicFirmware::release_brake() {
  if (!supervised()) feed_watchdog();
  brake_released_ = true;
  wiring_.release_brake(bus_.now());
}

void AicFirmware::trip(AicEmergency why, AicState state) {
  ++counters_.emergencies;
  switch_off();
  apply_brake();
  state_ = state;
  send(emergency_frame(card_, {why, state}), bus_.now());
}

void AicFirmware::trip_for(AicFault fault) {
  switch (fault) {
    case AicFault::kOverCurrent:
      return trip(AicEmergency::kOverCurrent, AicState::kFault);
    case AicFault::kEncoderError:
      return trip(AicEmergency::kEncoder, AicState::kFault);
    case AicFault::kSupply:
      return trip(AicEmergency::kSupply, AicState::kFault);
    case AicFault::kSilent:
    case AicFault::kEncoderStuck:
      return;  // it does not notice
  }
}

void AicFirmware::trip_for_lasting_faults() {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    if (faults_[i]) trip_for(static_cast<AicFault>(i));
  }
}

void AicFirmware::send_heartbeat(base::Time at) {
  const Heartbeat heartbeat{state_, kFirmwareVersion, whole_seconds(bus_.now() - started_)};
  heartbeat_waits_ = send(heartbeat_frame(card_, heartbeat), at);
}

bool AicFirmware::send(const can::Frame& frame, base::Time at) {
  const bool sent = station_.send_at(frame, at) == can::SendStatus::kSent;
  if (!sent) ++counters_.not_sent;
  return sent;
}

}  // namespace armature::janus
