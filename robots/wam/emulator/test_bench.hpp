// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/can/virtual_bus.hpp"
#include "robots/wam/emulator/emulator.hpp"
#include "robots/wam/emulator/rotors.hpp"

namespace armature::wam {

/// An emulated arm whose motors move nothing but themselves, a host's station, and all frames that
/// were on the wire.
class Bench {
 public:
  explicit Bench(std::size_t motors = kMostMotors) : Bench(Emulator::standard(motors)) {}
  explicit Bench(const Emulator::Config& config, const can::BusOptions& options = {})
      : rotors(config.pucks.size(), config.begin, Rotors::Config{}),
        emulator(Emulator::make(config, rotors).value()),
        host(emulator->bus().add_station("host")) {
    base::Diagnostics diagnostics;
    EXPECT_TRUE(host.open(options, diagnostics)) << diagnostics.to_text();
    emulator->bus().set_tap([this](const can::WireEvent& event) {
      if (keeps_log) log.push_back(event);
    });
  }

  base::Time now() const { return emulator->now(); }
  void advance(base::Duration time) { emulator->advance_to(now() + time); }
  SafetyBoard& board() { return emulator->board(); }
  /// By its node.
  Puck& puck(int node) { return emulator->puck(static_cast<std::size_t>(node - 1)); }

  void send(const std::string& frame) {
    EXPECT_EQ(host.send(can::parse_frame(frame).value()), can::SendStatus::kSent) << frame;
  }
  /// Sends it, waits until all is quiet, and gives the frames that were not the host's.
  std::vector<std::string> tell(const std::string& frame) {
    take_others();
    send(frame);
    advance(std::chrono::milliseconds(2));
    return take_others();
  }
  /// Frames since the last call that were not sent by the host, as text; the log is empty then.
  std::vector<std::string> take_others() {
    return take([this](const can::WireEvent& event) { return event.sender != &host; });
  }
  std::vector<std::string> take_own() {
    return take([this](const can::WireEvent& event) { return event.sender == &host; });
  }

  /// The operator gives the pucks power: their monitors run.
  void power_up() {
    board().reset();
    board().shift_idle();
    advance(std::chrono::milliseconds(400));
    log.clear();
  }
  /// Their main firmware runs.
  void wake_up() {
    power_up();
    tell("400#85000200");
    advance(std::chrono::seconds(1));
    log.clear();
  }
  void activate() {
    wake_up();
    board().shift_activate();
    advance(std::chrono::milliseconds(1));
    log.clear();
  }

  Rotors rotors;
  std::unique_ptr<Emulator> emulator;
  can::VirtualStation& host;
  std::vector<can::WireEvent> log;
  bool keeps_log = true;

 private:
  template <typename Which>
  std::vector<std::string> take(Which which) {
    std::vector<std::string> taken;
    for (const can::WireEvent& event : std::exchange(log, {})) {
      if (which(event)) taken.emplace_back(can::to_text(event.frame).view());
    }
    return taken;
  }
};

}  // namespace armature::wam
