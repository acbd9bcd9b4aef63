// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/can_link.hpp"

#include <utility>

#include "armature/can/make_bus.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"
#include "robots/wam/puck_protocol.hpp"

namespace armature::wam {

CanLink::CanLink(const std::string& bus) : bus_(can::make_bus(bus, kBitRate)) {}

bool CanLink::open(can::BusOptions options, base::Diagnostics& diagnostics) {
  options.on_news = [this] { news_.notify(); };
  return bus_->open(std::move(options), diagnostics);
}

base::Time CanLink::now() { return platform::monotonic_now(); }

/// The pucks' answers are what the cycle waits for.
void CanLink::wait_for_news(base::Time deadline) {
  const rt::PermitScope waiting;
  news_.wait_until(deadline);
}

}  // namespace armature::wam
