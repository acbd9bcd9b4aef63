// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulated_link.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::wam {

base::Result<std::unique_ptr<EmulatedLink>> EmulatedLink::make(const ArmNumbers& numbers,
                                                               const Config& config) {
  auto arm = ArmSimulation::load(numbers, config.arm);
  if (!arm) return base::Error{arm.error()};
  const bool real = config.time == Time::kReal;
  const base::Time begin = real ? platform::monotonic_now() : config.begin;
  std::unique_ptr<EmulatedLink> link(
      new EmulatedLink(numbers, std::move(arm).value(), config.time, begin));
  Emulator::Config emulated = Emulator::standard(numbers.joints());
  emulated.bus_name = "emulator";
  emulated.begin = begin;
  if (real) emulated.clock = platform::monotonic_now;
  auto emulator = Emulator::make(emulated, link->motors_);
  if (!emulator) return base::Error{emulator.error()};
  link->emulator_ = std::move(emulator).value();
  link->host_ = &link->emulator_->bus().add_station("host");
  return link;
}

bool EmulatedLink::open(can::BusOptions options, base::Diagnostics& diagnostics) {
  return host_->open(std::move(options), diagnostics);
}

void EmulatedLink::begin_run(base::Time time) {
  if (time_ == Time::kSimulated) ahead_ = emulator_->now() - time;
  begin_cycle(time);
}

void EmulatedLink::begin_cycle(base::Time time) {
  advance_to(time_ == Time::kReal ? platform::monotonic_now() : time + ahead_);
}

base::Time EmulatedLink::now() {
  return time_ == Time::kReal ? platform::monotonic_now() : emulator_->now();
}

void EmulatedLink::wait_for_news(base::Time deadline) {
  keep_holding();
  if (time_ == Time::kSimulated) {
    const std::uint64_t begin = platform::ticks();
    emulator_->advance_to_next_event(deadline);
    ticks_spent_ += platform::ticks() - begin;
    return;
  }
  const base::Time next = emulator_->next_event();
  {
    const rt::PermitScope waiting;
    platform::sleep_until(std::min(next, deadline));
  }
  advance_to(platform::monotonic_now());
}

void EmulatedLink::advance_to(base::Time now) {
  keep_holding();
  const std::uint64_t begin = platform::ticks();
  if (now > emulator_->now()) emulator_->advance_to(now);
  ticks_spent_ += platform::ticks() - begin;
}

/// A motor that drives has whoever holds the arm let go, so he takes it again.
void EmulatedLink::keep_holding() {
  if (held_ && !motors_.carried()) motors_.carry_to(home_);
}

double EmulatedLink::from_home() const {
  double most = 0.0;
  for (std::size_t i = 0; i < home_.size(); ++i) {
    most = std::max(most, std::abs(motors_.arm().joint_position(i) - home_[i]));
  }
  return most;
}

}  // namespace armature::wam
