// SPDX-License-Identifier: Apache-2.0
#include "armature/can/bus_link.hpp"

#include <utility>

#include "armature/can/make_bus.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::can {

BusLink::BusLink(const std::string& bus, std::uint32_t bit_rate) : bus_(make_bus(bus, bit_rate)) {}

bool BusLink::open(BusOptions options, base::Diagnostics& diagnostics) {
  options.on_news = [this] { news_.notify(); };
  return bus_->open(std::move(options), diagnostics);
}

base::Time BusLink::now() { return platform::monotonic_now(); }

/// The devices' answers are what a cycle waits for.
void BusLink::wait_for_news(base::Time deadline) {
  const rt::PermitScope waiting;
  news_.wait_until(deadline);
}

}  // namespace armature::can
