// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/puck_watch.hpp"

#include <utility>

#include "robots/wam/protocol/puck_properties.hpp"

namespace armature::wam {
namespace {

constexpr std::array<Property, kPuckReadings> kAsked{Property::kTemp, Property::kTherm,
                                                     Property::kImotor};

}  // namespace

PuckWatch::PuckWatch(const WamRecord& arm) : motors_(arm.motors) {
  for (std::size_t reading = 0; reading < kPuckReadings; ++reading) {
    for (std::size_t motor = 0; motor < motors_; ++motor) {
      all_[reading].numbers[motor] =
          number_of(PuckKind::kMotor, arm.pucks[motor].version, kAsked[reading]).value_or(-1);
    }
  }
}

void PuckWatch::start(base::Time now, const Config& config) {
  config_ = config;
  reading_ = motor_ = 0;
  waits_ = false;
  due_ = now;
  for (Round& round : all_) {
    round.answers = 0;
    round.rounds = 0;
  }
}

std::optional<can::Frame> PuckWatch::question(base::Time now) {
  if (config_.period <= base::Duration::zero()) return std::nullopt;
  if (waits_ && now >= deadline_) {
    ++counters_.missed;
    go_on();
  }
  if (waits_ || now < due_) return std::nullopt;
  due_ += config_.period;
  if (due_ <= now) due_ = now + config_.period;  // cycles were left out
  const int number = all_[reading_].numbers[motor_];
  if (number < 0) {
    go_on();
    return std::nullopt;
  }
  waits_ = true;
  deadline_ = now + config_.answer_timeout;
  ++counters_.asked;
  return get_frame(to_node(static_cast<int>(motor_) + 1), number);
}

void PuckWatch::take_back() {
  waits_ = false;
  --counters_.asked;
}

bool PuckWatch::take(int node, const can::Frame& frame) {
  Round& round = all_[reading_];
  const bool asked = waits_ && node == static_cast<int>(motor_) + 1;
  const auto value = asked ? parse_reply(frame, round.numbers[motor_]) : std::nullopt;
  if (!value) {
    ++counters_.unexpected;
    return false;
  }
  round.coming[motor_] = *value;
  ++round.answers;
  go_on();
  return true;
}

/// To the next puck, or with the first one to the next reading.
void PuckWatch::go_on() {
  waits_ = false;
  if (++motor_ < motors_) return;
  Round& round = all_[reading_];
  if (std::exchange(round.answers, 0) == motors_) {
    round.told = round.coming;
    ++round.rounds;
  }
  motor_ = 0;
  reading_ = (reading_ + 1) % kPuckReadings;
}

}  // namespace armature::wam
