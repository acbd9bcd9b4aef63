// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/simulated_link.hpp"

#include <algorithm>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::janus {

base::Result<std::unique_ptr<SimulatedLink>> SimulatedLink::make(const Head::Config& head,
                                                                 Time time, base::Time now) {
  std::unique_ptr<SimulatedLink> link(new SimulatedLink(time));
  Simulation::Config config{.head = head};
  config.head.begin = now;
  if (time == Time::kReal) config.clock = platform::monotonic_now;
  auto simulation = Simulation::make(config);
  if (!simulation) return base::Error{simulation.error()};
  link->simulation_ = std::move(simulation).value();
  link->host_ = &link->simulation_->bus().add_station("host");
  return link;
}

bool SimulatedLink::open(can::BusOptions options, base::Diagnostics& diagnostics) {
  return host_->open(std::move(options), diagnostics);
}

void SimulatedLink::begin_cycle(base::Time time) {
  advance_to(time_ == Time::kReal ? platform::monotonic_now() : time);
}

base::Time SimulatedLink::now() {
  return time_ == Time::kReal ? platform::monotonic_now() : simulation_->now();
}

void SimulatedLink::wait_for_news(base::Time deadline) {
  if (time_ == Time::kSimulated) {
    const std::uint64_t begin = platform::ticks();
    simulation_->advance_to_next_event(deadline);
    ticks_spent_ += platform::ticks() - begin;
    return;
  }
  const base::Time next = simulation_->next_event();
  {
    const rt::PermitScope waiting;
    platform::sleep_until(std::min(next, deadline));
  }
  advance_to(platform::monotonic_now());
}

void SimulatedLink::advance_to(base::Time now) {
  const std::uint64_t begin = platform::ticks();
  if (now > simulation_->now()) simulation_->advance_to(now);
  ticks_spent_ += platform::ticks() - begin;
}

}  // namespace armature::janus
