// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_host.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::janus {

using component::Outcome;

namespace {

bool is(int command, AicCommand expected) { return command == static_cast<int>(expected); }

}  // namespace

Outcome AicHost::on_configure() {
  const AicDriver::Config driving = config();
  auto link = make_link();
  if (!link) return component::refused(link.error());
  link_ = std::move(link).value();
  base::Diagnostics diagnostics;
  if (!link_->open(AicDriver::bus_options(driving), diagnostics)) {
    return component::refused(base::as_reason(diagnostics));
  }
  auto driver = AicDriver::make(link_->bus(), driving);
  if (!driver) return component::refused(driver.error());
  driver_.emplace(std::move(driver).value());
  accounts_.assign(driver_->cards(), {});
  index_of_.assign(kMostCards + 1, std::nullopt);
  for (std::size_t i = 0; i < driver_->cards(); ++i) {
    index_of_[static_cast<std::size_t>(driver_->card(i).number)] = i;
  }
  return begin_to_guard();
}

AicDriver::Config AicHost::config() const {
  AicDriver::Config config;
  config.cards = numbers_.get();
  config.mode = mode_;
  config.answer_timeout = base::from_seconds(answer_timeout_);
  return config;
}

Outcome AicHost::on_start() {
  link_->begin_run(time());
  driver_->start(link_->now());
  read_at_ = base::Time::min();
  lost_answers_.assign(0);
  bus_lost_.assign(0);
  make_safe();
  return component::accepted();
}

void AicHost::on_cleanup() {
  end_guard();
  driver_.reset();
  link_.reset();
}

AicSample AicHost::read_card(int number) {
  const auto index = index_of(number);
  if (!index || state() != component::State::kRunning) return {.no_bus = true};
  if (read_at_ != time() && !is_guarded()) return {.no_bus = true};
  if (read_at_ != time()) read_all();
  return take(*index);
}

void AicHost::read_all() {
  read_at_ = time();
  link_->begin_cycle(time());
  if (motors_set_ > 0) send_motors();
  driver_->begin_reading(link_->now());
  while (driver_->poll(link_->now()) == AicReading::kWaiting) {
    link_->wait_for_news(driver_->deadline());
  }
  for (Account& account : accounts_) account.taken = false;
  if (driver_->reading() != AicReading::kComplete) note_losses();
}

void AicHost::note_losses() {
  if (driver_->reading() == AicReading::kNoBus) {
    bus_lost_.assign(bus_lost_() + 1);
    if (bus_lost_() == 1)
      log_error("the bus '{}' is {}", link_->bus().name(), can::to_text(driver_->bus_state()));
    return;
  }
  int lost = 0;
  for (std::size_t i = 0; i < driver_->cards(); ++i) lost += driver_->card(i).fresh ? 0 : 1;
  lost_answers_.assign(lost_answers_() + lost);
}

/// Each answer once.
AicSample AicHost::take(std::size_t index) {
  const AicCard& card = driver_->card(index);
  Account& account = accounts_[index];
  AicSample sample{.no_bus = driver_->reading() == AicReading::kNoBus};
  if (!card.fresh || std::exchange(account.taken, true)) return sample;
  sample.fresh = true;
  sample.counts = card.counts - std::exchange(account.counts, card.counts);
  sample.index = card.report.index;
  sample.actuator_on = card.report.actuator_on;
  const std::uint64_t restarts = card.counters.restarts;
  const std::uint64_t lost = card.counters.lost_reports;
  sample.restarted = std::exchange(account.restarts, restarts) != restarts;
  sample.counts_lost = std::exchange(account.lost_reports, lost) != lost;
  return sample;
}

bool AicHost::set_motor(int number, control::LimitedEffort effort) {
  const auto index = index_of(number);
  if (!index) return false;
  driver_->set_motor(*index, effort / supply_);
  Account& account = accounts_[*index];
  account.motor_set_at = time();
  if (!std::exchange(account.motor_set, true)) ++motors_set_;
  return motors_set_ < accounts_.size() || send_motors();
}

bool AicHost::send_motors() {
  motors_set_ = 0;
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    accounts_[i].motor_set = false;
    if (time() - accounts_[i].motor_set_at > controllers::kMaxAge) driver_->set_motor(i, 0.0);
  }
  return driver_->send_motors() == can::SendStatus::kSent;
}

bool AicHost::make_card_safe(int number, int command) {
  const bool safe = is(command, AicCommand::kActuatorOff) || is(command, AicCommand::kBrakeApply);
  return safe && command_card(number, static_cast<AicCommand>(command));
}

bool AicHost::energize_card(int number, int command, control::DrivePermit permit) {
  const bool known = is(command, AicCommand::kActuatorOn) || is(command, AicCommand::kBrakeRelease);
  return permit && known && command_card(number, static_cast<AicCommand>(command));
}

bool AicHost::command_card(int number, AicCommand command) {
  const auto index = index_of(number);
  return index && driver_->command(*index, command) == can::SendStatus::kSent;
}

void AicHost::make_safe() {
  for (std::size_t i = 0; i < driver_->cards(); ++i) driver_->set_motor(i, 0.0);
  send_motors();
  for (std::size_t i = 0; i < driver_->cards(); ++i) {
    driver_->command(i, AicCommand::kBrakeApply);
    driver_->command(i, AicCommand::kActuatorOff);
  }
  rest();
}

std::optional<std::size_t> AicHost::index_of(int number) const {
  const bool known = number >= 1 && number <= kMostCards && driver_;
  return known ? index_of_[static_cast<std::size_t>(number)] : std::nullopt;
}

}  // namespace armature::janus
