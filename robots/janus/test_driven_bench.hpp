// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "robots/janus/aic/aic_driver.hpp"
#include "robots/janus/test_bench.hpp"

namespace armature::janus {

/// A driver for cards 1 and 2 on the bench, which polls whenever there is news.
struct Driven : Bench {
  explicit Driven(AicMode mode = AicMode::kSequential) : Driven(AicDriver::Config{{1, 2}, mode}) {}
  explicit Driven(const AicDriver::Config& config) : driver(AicDriver::make(host, config).value()) {
    can::Arrival arrival;
    while (host.receive(arrival) == can::ReceiveStatus::kReceived) {
    }
    on_news = [this] { driver.poll(bus.now()); };
    driver.start(bus.now());
  }
  AicReading begin() { return driver.begin_reading(bus.now()); }
  /// A whole reading; it has ended then.
  AicReading read() {
    begin();
    while (driver.reading() == AicReading::kWaiting) {
      advance(
          std::min<base::Duration>(driver.deadline() - bus.now(), std::chrono::microseconds(100)));
      driver.poll(bus.now());
    }
    return driver.reading();
  }
  /// The frames that the host sent since the last call.
  std::vector<std::string> take_sent() {
    std::vector<std::string> sent;
    for (const auto& event : std::exchange(log, {})) {
      if (event.sender == &host) sent.emplace_back(can::to_text(event.frame).view());
    }
    return sent;
  }
  const AicCard& first() const { return driver.card(0); }
  const AicCard& second() const { return driver.card(1); }
  AicFirmware& firmware(std::size_t index) { return *cards[index]; }
  /// The next sensor frames of card 1 are acknowledged, but received by nobody.
  void lose_reports(std::uint64_t count) { bus.lose_next(count, can::Filter{.id = 0x181}); }

  AicDriver driver;
};

}  // namespace armature::janus
