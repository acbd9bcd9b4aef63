// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/background_sdo.hpp"

#include <array>
#include <span>

#include "drives/canopen/little_endian.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/cia402/drive_settings.hpp"

namespace armature::cia402 {

using canopen::SdoClient;
using canopen::SdoStep;

BackgroundSdo::BackgroundSdo(const DriveGroup& drives, base::Duration pause) : pause_(pause) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const DriveConfig& config = drives.config(i);
    errands_.push_back({.client = SdoClient(config.node, kPatience, SdoClient::kNumberBytes),
                        .steps = config.preparation,
                        .numbers = {}});
    for (const canopen::Address address : config.slow) {
      questions_.push_back({i, errands_.back().numbers.size()});
      errands_.back().numbers.push_back({.address = address});
    }
  }
}

void BackgroundSdo::take(const can::Frame& frame, base::Time now) noexcept {
  if (!busy_) return;
  if (const auto reply = errands_[*busy_].client.take(frame, now)) reply_ = reply;
}

void BackgroundSdo::step(can::Bus& bus, base::Time now) noexcept {
  if (busy_) {
    Errands& errands = errands_[*busy_];
    if (!reply_) reply_ = errands.client.check(now);
    if (reply_) send(bus, *reply_);
    reply_.reset();
    if (errands.client.status() == SdoClient::Status::kBusy) return;
    prepares_ ? end_step(errands) : end_question(errands);
    busy_.reset();
  }
  for (Errands& errands : errands_) {
    if (!errands.starts) continue;
    errands.starts = false;
    send(bus, canopen::nmt_frame(canopen::NmtCommand::kStart, errands.client.node()));
    return;
  }
  if (!begin_preparation(bus, now)) begin_question(bus, now);
}

void BackgroundSdo::prepare_again(std::size_t drive) noexcept {
  Errands& errands = errands_[drive];
  errands.starts = errands.steps.empty();
  errands.preparation = errands.starts ? Preparation::kDone : Preparation::kUnderWay;
  errands.step = 0;
}

bool BackgroundSdo::begin_preparation(can::Bus& bus, base::Time now) noexcept {
  for (std::size_t drive = 0; drive < errands_.size(); ++drive) {
    Errands& errands = errands_[drive];
    if (errands.preparation != Preparation::kUnderWay) continue;
    const SdoStep& step = errands.steps[errands.step];
    std::array<std::uint8_t, SdoClient::kNumberBytes> bytes{};
    canopen::store(bytes, step.value);
    busy_ = drive;
    prepares_ = true;
    send(bus, step.is_written ? errands.client.begin_download(
                                    step.address, std::span(bytes).first(step.bytes), now)
                              : errands.client.begin_upload(step.address, now));
    return true;
  }
  return false;
}

void BackgroundSdo::end_step(Errands& errands) noexcept {
  const SdoStep& step = errands.steps[errands.step];
  const auto& bytes = errands.client.bytes();
  const bool is_done = errands.client.status() == SdoClient::Status::kDone;
  const bool is_equal =
      step.is_written || (bytes.size() == step.bytes && canopen::load(bytes) == step.value);
  if (!is_done || !is_equal) {
    errands.preparation = Preparation::kRefused;
    errands.refused_at = step.address;
    return;
  }
  if (++errands.step < errands.steps.size()) return;
  errands.preparation = Preparation::kDone;
  errands.starts = true;
}

void BackgroundSdo::begin_question(can::Bus& bus, base::Time now) noexcept {
  if (questions_.empty() || now < next_question_) return;
  next_question_ = base::later(now, pause_);
  const Question& question = questions_[question_];
  question_ = (question_ + 1) % questions_.size();
  Errands& errands = errands_[question.drive];
  const Number& number = errands.numbers[question.number];
  if (number.is_refused) return;
  busy_ = question.drive;
  prepares_ = false;
  send(bus, errands.client.begin_upload(number.address, now));
}

/// A drive that says no has no such number; one that says nothing is asked again.
void BackgroundSdo::end_question(Errands& errands) noexcept {
  const SdoClient& client = errands.client;
  for (Number& number : errands.numbers) {
    if (number.address != client.address()) continue;
    if (client.status() == SdoClient::Status::kDone && !client.bytes().empty()) {
      const auto bits = static_cast<unsigned>(8 * client.bytes().size());
      number.value = canopen::sign_extended(canopen::load(client.bytes()), bits);
    } else if (client.abort_code() != canopen::AbortCode::kTimeout) {
      number.is_refused = true;
    }
  }
}

void BackgroundSdo::end_heartbeat(can::Bus& bus, base::Time now) noexcept {
  constexpr std::array<std::uint8_t, 4> kNobody{};
  for (Errands& errands : errands_) {
    send(bus, errands.client.begin_download(kConsumedHeartbeat, kNobody, now));
  }
  busy_.reset();
}

/// What the bus does not take runs out of its time, and is a refusal then.
void BackgroundSdo::send(can::Bus& bus, const can::Frame& frame) noexcept {
  static_cast<void>(bus.send(frame));
}

}  // namespace armature::cia402
