// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_driver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace armature::janus {
namespace {

bool usable(can::BusState state) {
  return state == can::BusState::kActive || state == can::BusState::kPassive;
}

bool is_lost(can::SendStatus status) {
  return status == can::SendStatus::kBusOff || status == can::SendStatus::kDown;
}

/// Keeps the first that is not kSent.
void keep_first_failure(can::SendStatus& all, can::SendStatus next) {
  if (all == can::SendStatus::kSent) all = next;
}

std::string check(const AicDriver::Config& config) {
  if (config.cards.empty()) return "no cards, expected at least one";
  for (auto card = config.cards.begin(); card != config.cards.end(); ++card) {
    if (*card < 1 || *card > kMostCards) {
      return "card " + std::to_string(*card) + ", expected 1 to " + std::to_string(kMostCards);
    }
    if (std::find(config.cards.begin(), card, *card) != card) {
      return "card " + std::to_string(*card) + " twice, expected different numbers";
    }
  }
  if (config.answer_timeout <= base::Duration{}) return "answer_timeout is not above 0";
  if (config.silence_timeout <= kHeartbeatPeriod) {
    return "silence_timeout is not above 100 ms, the period of heartbeats";
  }
  return "";
}

bool has_restarted(const std::optional<Heartbeat>& last, const Heartbeat& now) {
  return last && (now.uptime_s < last->uptime_s ||
                  (now.state == AicState::kStarted && last->state != AicState::kStarted));
}

void note_restart(AicCard& card) {
  ++card.counters.restarts;
  card.counts_exact = false;
}

void take_heartbeat(AicCard& card, const Heartbeat& heartbeat) {
  if (has_restarted(card.heartbeat, heartbeat)) {
    note_restart(card);
    card.restarted = true;
  }
  card.heartbeat = heartbeat;
}

void take_emergency(AicCard& card, const Emergency& emergency) {
  ++card.counters.emergencies;
  card.emergency = emergency;
}

/// How many reports were made between the last one and this.
int reports_missed(const AicCard& card, const SensorReport& report) {
  return card.restarted ? report.counter : reports_since(card.report.counter, report.counter) - 1;
}

/// Adds the counts of a report, and sees from its counter whether others are missing.
void add_counts(AicCard& card, const SensorReport& report) {
  if (!card.reported) {
    card.reported = true;
    card.counts_exact = true;
    return;
  }
  card.counts += report.counts;
  if (report.counter == 0 && !card.restarted) {
    note_restart(card);
    card.heartbeat.reset();  // the next would tell of the same restart
  } else if (const int missed = reports_missed(card, report); missed > 0) {
    card.counters.lost_reports += static_cast<std::uint64_t>(missed);
    card.counts_exact = false;
  }
}

bool is_repeated(const AicCard& card, const SensorReport& report) {
  return card.reported && !card.restarted && report.counter != 0 &&
         report.counter == card.report.counter;
}

}  // namespace

base::Result<AicDriver> AicDriver::make(can::Bus& bus, const Config& config) {
  const std::string mistake = check(config);
  if (!mistake.empty()) return base::Error{"AicDriver on bus '" + bus.name() + "': " + mistake};
  return AicDriver(bus, config);
}

can::BusOptions AicDriver::bus_options(const Config& config) {
  can::BusOptions options;
  options.error_frames = true;
  for (const int card : config.cards) {
    options.filters.push_back({.id = static_cast<std::uint32_t>(card), .mask = 0x07f});
  }
  // A reading's requests and motor frames may wait at once, and commands beside them.
  options.send_capacity = std::max<std::size_t>(options.send_capacity, 8 * config.cards.size());
  options.receive_capacity =
      std::max<std::size_t>(options.receive_capacity, 16 * config.cards.size());
  return options;
}

AicDriver::AicDriver(can::Bus& bus, const Config& config)
    : bus_(&bus),
      mode_(config.mode),
      answer_timeout_(config.answer_timeout),
      silence_timeout_(config.silence_timeout),
      cards_(config.cards.size()),
      motors_(config.cards.size(), 0),
      index_of_(kMostCards + 1, config.cards.size()) {
  for (std::size_t index = 0; index < cards_.size(); ++index) {
    cards_[index].number = config.cards[index];
    index_of_[static_cast<std::size_t>(config.cards[index])] = index;
  }
  for (int group = 0; group <= group_of(kMostCards); ++group) {
    const auto in_group = [group](int card) { return group_of(card) == group; };
    if (std::ranges::any_of(config.cards, in_group)) groups_.push_back(group);
  }
}

void AicDriver::start(base::Time now) {
  bus_offs_seen_ = bus_->counters().bus_offs;
  reading_ = AicReading::kNone;
  clear_motors();
  for (AicCard& card : cards_) card.heard = now;
}

AicReading AicDriver::begin_reading(base::Time now) {
  take_frames();
  if (reading_ == AicReading::kWaiting) finish();
  if (bus_was_lost()) return lose_bus();
  for (AicCard& card : cards_) card.fresh = false;
  reading_ = AicReading::kWaiting;
  if (mode_ == AicMode::kSequential) {
    ask_cards_from(0, now);
  } else {
    ask_all(now);
  }
  return reading_;
}

AicReading AicDriver::poll(base::Time now) {
  take_frames();
  if (reading_ != AicReading::kWaiting) return reading_;
  if (bus_was_lost()) return lose_bus();
  go_on(now);
  if (reading_ == AicReading::kWaiting && now >= deadline_) give_up(now);
  return reading_;
}

void AicDriver::set_motor(std::size_t index, double share) {
  if (!std::isfinite(share)) {
    ++cards_[index].counters.not_finite;
    share = 0.0;
  }
  motors_[index] = motor_value(share);
}

can::SendStatus AicDriver::send_motors() {
  auto status = can::SendStatus::kSent;
  if (mode_ == AicMode::kSynchronous) {
    status = send_groups();
  } else {
    for (std::size_t index = 0; index < cards_.size(); ++index) {
      AicCard& card = cards_[index];
      keep_first_failure(status,
                         send(motor_frame(card.number, motors_[index]), card.counters.not_sent));
    }
  }
  if (is_lost(status)) clear_motors();
  return status;
}

can::SendStatus AicDriver::command(std::size_t index, AicCommand command) {
  if (command == AicCommand::kWatchdog) return can::SendStatus::kInvalid;
  AicCard& card = cards_[index];
  return send(command_frame(card.number, command), card.counters.not_sent);
}

can::SendStatus AicDriver::set_watchdog(std::size_t index, base::Duration time) {
  using std::chrono::milliseconds;
  const auto whole = std::chrono::duration_cast<milliseconds>(time);
  if (whole != time || whole < milliseconds(1) || whole > milliseconds(0xffff)) {
    return can::SendStatus::kInvalid;
  }
  AicCard& card = cards_[index];
  return send(watchdog_frame(card.number, static_cast<std::uint16_t>(whole.count())),
              card.counters.not_sent);
}

bool AicDriver::silent(std::size_t index, base::Time now) const {
  return now - cards_[index].heard > silence_timeout_;
}

void AicDriver::accept_counts(std::size_t index, std::int64_t counts) {
  cards_[index].counts = counts;
  cards_[index].counts_exact = cards_[index].reported;
}

/// Also when it has come back since: nothing of before is to go on as if nothing had happened.
bool AicDriver::bus_was_lost() const {
  return !usable(bus_->state()) || bus_->counters().bus_offs != bus_offs_seen_;
}

AicReading AicDriver::lose_bus() {
  ++bus_counters_.bus_lost;
  bus_offs_seen_ = bus_->counters().bus_offs;
  clear_motors();
  for (AicCard& card : cards_) card.fresh = false;
  static_cast<void>(bus_->restart());
  return reading_ = AicReading::kNoBus;
}

void AicDriver::clear_motors() { std::ranges::fill(motors_, std::int16_t{0}); }

void AicDriver::ask_all(base::Time now) {
  const can::SendStatus status = send(sync_frame(sync_counter_), bus_counters_.not_sent);
  deadline_ = now + answer_timeout_;
  if (status == can::SendStatus::kSent) {
    ++sync_counter_;
  } else if (is_lost(status)) {
    lose_bus();
  } else {
    finish();
  }
}

/// Asks the first card that can be asked.
void AicDriver::ask_cards_from(std::size_t index, base::Time now) {
  for (asked_ = index; asked_ < cards_.size(); ++asked_) {
    AicCard& card = cards_[asked_];
    const can::SendStatus status = send(request_frame(card.number), card.counters.not_sent);
    deadline_ = now + answer_timeout_;
    if (status == can::SendStatus::kSent) return;
    if (is_lost(status)) {
      lose_bus();
      return;
    }
  }
  finish();
}

void AicDriver::go_on(base::Time now) {
  if (mode_ == AicMode::kSynchronous) {
    if (all_fresh()) finish();
  } else if (cards_[asked_].fresh) {
    ask_cards_from(asked_ + 1, now);
  }
}

void AicDriver::give_up(base::Time now) {
  if (mode_ == AicMode::kSynchronous) {
    finish();
  } else {
    ask_cards_from(asked_ + 1, now);
  }
}

void AicDriver::finish() {
  for (AicCard& card : cards_) {
    if (!card.fresh) ++card.counters.lost_answers;
  }
  reading_ = all_fresh() ? AicReading::kComplete : AicReading::kIncomplete;
}

bool AicDriver::all_fresh() const { return std::ranges::all_of(cards_, &AicCard::fresh); }

void AicDriver::take_frames() {
  can::Arrival arrival;
  while (bus_->receive(arrival) == can::ReceiveStatus::kReceived) {
    if (!arrival.own) take(arrival);
  }
}

void AicDriver::take(const can::Arrival& arrival) {
  if (arrival.frame.kind == can::FrameKind::kError) {
    ++bus_counters_.error_frames;
    return;
  }
  const std::optional<AicAddress> address = address_of(arrival.frame);
  const bool of_a_card = address && address->function != AicFunction::kMotorGroup;
  const std::size_t index =
      of_a_card ? index_of_[static_cast<std::size_t>(address->number)] : cards_.size();
  if (index == cards_.size()) {
    ++bus_counters_.unknown_frames;
  } else {
    take_from(cards_[index], address->function, arrival);
  }
}

void AicDriver::take_from(AicCard& card, AicFunction function, const can::Arrival& arrival) {
  const can::Frame& frame = arrival.frame;
  bool valid = false;
  if (function == AicFunction::kSensor) {
    const auto report = parse_sensor(frame);
    valid = report.has_value();
    if (valid) take_sensor(card, *report, arrival.time);
  } else if (function == AicFunction::kHeartbeat) {
    const auto heartbeat = parse_heartbeat(frame);
    valid = heartbeat.has_value();
    if (valid) take_heartbeat(card, *heartbeat);
  } else if (function == AicFunction::kEmergency) {
    const auto emergency = parse_emergency(frame);
    valid = emergency.has_value();
    if (valid) take_emergency(card, *emergency);
  } else {
    ++card.counters.unexpected;
    return;
  }
  if (valid) {
    card.heard = std::max(card.heard, arrival.time);
  } else {
    ++card.counters.malformed;
  }
}

void AicDriver::take_sensor(AicCard& card, const SensorReport& report, base::Time time) {
  if (is_repeated(card, report)) {
    ++card.counters.repeated;
    return;
  }
  add_counts(card, report);
  card.restarted = false;
  card.report = report;
  card.report_time = time;
  answer(card, time);
}

/// A report is this reading's answer if its card was asked and has not answered.
void AicDriver::answer(AicCard& card, base::Time time) {
  const auto index = static_cast<std::size_t>(&card - cards_.data());
  const bool synchronous = mode_ == AicMode::kSynchronous;
  const bool asked = reading_ == AicReading::kWaiting && (synchronous || index <= asked_);
  const bool in_time = asked && (synchronous || index == asked_) && !card.fresh;
  if (!in_time) ++card.counters.late_answers;
  if (asked) card.fresh = true;
  if (synchronous && in_time) deadline_ = time + answer_timeout_;
}

can::SendStatus AicDriver::send(const can::Frame& frame, std::uint64_t& not_sent) {
  const can::SendStatus status = bus_->send(frame);
  if (status != can::SendStatus::kSent) ++not_sent;
  return status;
}

can::SendStatus AicDriver::send_groups() {
  auto status = can::SendStatus::kSent;
  for (const int group : groups_) {
    GroupValues values{};
    for (std::size_t index = 0; index < cards_.size(); ++index) {
      const int number = cards_[index].number;
      if (group_of(number) != group) continue;
      values[static_cast<std::size_t>(place_in_group(number))] = motors_[index];
    }
    keep_first_failure(status, send(motor_group_frame(group, values), bus_counters_.not_sent));
  }
  return status;
}

}  // namespace armature::janus
