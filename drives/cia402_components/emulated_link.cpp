// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/emulated_link.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::cia402 {
namespace {

/// In which drives see what came on the bus; about half of a frame.
constexpr base::Duration kStep = std::chrono::microseconds(50);

}  // namespace

base::Result<std::unique_ptr<EmulatedLink>> EmulatedLink::make(EmulatedBus::Config config,
                                                               Time time, base::Time now) {
  std::unique_ptr<EmulatedLink> link(new EmulatedLink(time, now));
  config.clock = [at = link.get()] { return at->now_; };
  config.begin = now;
  auto drives = EmulatedBus::make(config);
  if (!drives) return base::Error{drives.error()};
  link->drives_ = std::move(drives).value();
  link->host_ = &link->drives_->bus().add_station("host");
  return link;
}

bool EmulatedLink::open(can::BusOptions options, base::Diagnostics& diagnostics) {
  return host_->open(options, diagnostics);
}

void EmulatedLink::begin_run(base::Time time) {
  if (time_ == Time::kSimulated) ahead_ = now_ - time;
  begin_cycle(time);
}

void EmulatedLink::begin_cycle(base::Time time) {
  advance_to(time_ == Time::kReal ? platform::monotonic_now() : time + ahead_);
}

void EmulatedLink::wait_for_news(base::Time deadline) {
  const std::uint64_t seen = host_->counters().received;
  while (now_ < deadline && host_->counters().received == seen) {
    if (time_ == Time::kSimulated) {
      advance_to(std::min(deadline, now_ + kStep));
      continue;
    }
    {
      const rt::PermitScope waiting;
      platform::sleep_until(std::min(deadline, now_ + kStep));
    }
    advance_to(platform::monotonic_now());
  }
}

void EmulatedLink::advance_to(base::Time now) {
  while (now_ < now) {
    now_ = std::min(now, now_ + kStep);
    drives_->advance_to(now_);
  }
}

}  // namespace armature::cia402
