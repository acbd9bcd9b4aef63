// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/can/virtual_bus.hpp"
#include "robots/janus/aic/aic_firmware.hpp"

namespace armature::janus {

/// What a card is wired to in tests: what it is to see, and what it did.
class FakeWiring final : public AicWiring {
 public:
  std::int64_t take_counts(base::Time) override { return std::exchange(counts, 0); }
  bool index_closed(base::Time) override { return index; }
  double motor_current(base::Time) override { return current; }
  void drive(double share, base::Time) override { motor = share; }
  void switch_off(base::Time) override { motor = kOff; }
  void apply_brake(base::Time) override { brake_released = false; }
  void release_brake(base::Time) override { brake_released = true; }

  static constexpr double kOff = -1000.0;
  std::int64_t counts = 0;
  bool index = false;
  double current = 0.0;
  double motor = kOff;
  bool brake_released = false;
};

/// Cards 1 and 2 on a bench, with a host's station, and all frames that were on the wire.
class Bench {
 public:
  Bench() {
    base::Diagnostics diagnostics;
    can::BusOptions options;
    options.on_news = [this] {
      if (on_news) on_news();
    };
    EXPECT_TRUE(host.open(options, diagnostics)) << diagnostics.to_text();
    for (const auto& each : cards) {
      EXPECT_TRUE(each->power_on(diagnostics)) << diagnostics.to_text();
    }
    bus.set_tap([this](const can::WireEvent& event) {
      if (keeps_log) log.push_back(event);
    });
    advance(std::chrono::milliseconds(1));  // behind the first heartbeats
    log.clear();
  }

  void advance(base::Duration time) {
    const base::Time until = bus.now() + time;
    do {
      base::Time next = std::min(until, bus.next_event().value_or(until));
      for (const auto& each : cards) next = std::min(next, each->next_deadline());
      bus.advance_to(next);
      for (const auto& each : cards) each->run_timers();
    } while (bus.now() < until);
  }
  void send(const can::Frame& frame) { EXPECT_EQ(host.send(frame), can::SendStatus::kSent); }
  /// Sends it and waits until all is quiet.
  void tell(const can::Frame& frame) {
    send(frame);
    advance(std::chrono::milliseconds(1));
  }
  /// The frames since the last call that were not sent by the host, as text.
  std::vector<std::string> take_answers() {
    std::vector<std::string> answers;
    for (const can::WireEvent& event : log) {
      if (event.sender != &host) answers.emplace_back(can::to_text(event.frame).view());
    }
    log.clear();
    return answers;
  }

  can::VirtualBus bus{"can0", kBitRate, [this] { return bus.now(); }};
  can::VirtualStation& host = bus.add_station("host");
  std::function<void()> on_news;
  std::array<FakeWiring, 2> joints;
  std::array<std::unique_ptr<AicFirmware>, 2> cards{
      std::make_unique<AicFirmware>(1, bus, joints[0]),
      std::make_unique<AicFirmware>(2, bus, joints[1])};
  AicFirmware& card = *cards[0];
  FakeWiring& joint = joints[0];
  std::vector<can::WireEvent> log;
  bool keeps_log = true;
};

/// A card that is on and whose brake is released, since `since`.
struct Running : Bench {
  Running() {
    send(command_frame(1, AicCommand::kActuatorOn));
    send(command_frame(1, AicCommand::kBrakeRelease));
    send(motor_frame(1, 1000));
    advance(std::chrono::milliseconds(1));
    since = log.back().end;
    log.clear();
  }
  void wait_until(base::Time time) { advance(time - bus.now()); }
  base::Time since;
};

}  // namespace armature::janus
