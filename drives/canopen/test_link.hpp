// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "armature/base/diagnostic.hpp"
#include "armature/can/link.hpp"
#include "armature/can/virtual_bus.hpp"

namespace armature::canopen {

/// A virtual bus in simulated time with a host that waits, and what devices do meanwhile.
class TestLink : public can::Link {
 public:
  TestLink() { EXPECT_TRUE(open({}, diagnostics_)) << diagnostics_.to_text(); }

  can::Bus& bus() override { return host_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override {
    return host_.open(options, diagnostics);
  }
  void begin_cycle(base::Time /*time*/) override {}
  base::Time now() override { return now_; }
  /// Until something has come, or the deadline.
  void wait_for_news(base::Time deadline) override {
    while (now_ < deadline && host_.counters().received == seen_) advance(kStep);
    seen_ = host_.counters().received;
  }

  /// Another station, open.
  can::VirtualStation& station() {
    can::VirtualStation& added = wire_.add_station("device");
    EXPECT_TRUE(added.open({}, diagnostics_)) << diagnostics_.to_text();
    return added;
  }
  /// Called in each step of time.
  void add_party(std::function<void(base::Time)> party) { parties_.push_back(std::move(party)); }

  void advance(base::Duration by) {
    const base::Time until = now_ + by;
    while (now_ < until) {
      now_ = std::min(until, now_ + kStep);
      wire_.advance_to(now_);
      for (const auto& party : parties_) party(now_);
    }
  }
  /// Everything that the host has received.
  std::vector<can::Frame> received() {
    std::vector<can::Frame> frames;
    can::Arrival arrival;
    while (host_.receive(arrival) == can::ReceiveStatus::kReceived) frames.push_back(arrival.frame);
    return frames;
  }
  can::VirtualBus& wire() { return wire_; }

 private:
  static constexpr base::Duration kStep = std::chrono::microseconds(50);

  base::Time now_{};
  can::VirtualBus wire_{"can0", 1'000'000, [this] { return now_; }};
  can::VirtualStation& host_ = wire_.add_station("host");
  base::Diagnostics diagnostics_;
  std::vector<std::function<void(base::Time)>> parties_;
  std::uint64_t seen_ = 0;
};

}  // namespace armature::canopen
