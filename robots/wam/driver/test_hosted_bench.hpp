// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "robots/wam/driver/wam_driver.hpp"
#include "robots/wam/driver/wam_startup.hpp"
#include "robots/wam/emulator/test_bench.hpp"

namespace armature::wam {

/// Motor angles [rad] at joints (0, -2, 0, 3.13, 0, 0, 0).
constexpr std::array<double, kMostMotors> kHome{0.0, -56.5, 56.5, -56.34, 0.0, 0.0, 0.0};

/// An emulated arm with a host that starts it up and then runs its cycle, both in simulated time.
struct Hosted : Bench {
  static constexpr base::Duration kPeriod = std::chrono::milliseconds(2);

  explicit Hosted(std::size_t motors = kMostMotors) : Hosted(Emulator::standard(motors)) {}
  explicit Hosted(const Emulator::Config& config) : Hosted(config, config.pucks.size()) {}
  /// @param expected  motors of the arm that the host expects
  Hosted(const Emulator::Config& config, std::size_t expected)
      : Bench(config, WamDriver::bus_options()) {
    WamStartup::Config wanted;
    wanted.motors = expected;
    wanted.home = kHome;
    startup = WamStartup::make(host, wanted).value();
  }

  // ---- Starting up

  /// Talks until nothing is left to say, or the operator has to act.
  WamProgress talk(base::Duration at_most = std::chrono::seconds(20)) {
    const base::Time end = now() + at_most;
    WamProgress progress = startup->poll(now());
    while (progress == WamProgress::kTalking && now() < end) {
      emulator->advance_to_next_event(std::min(startup->deadline(), end));
      progress = startup->poll(now());
    }
    return progress;
  }
  /// Goes on talking for so long, whatever the progress is.
  WamProgress talk_for(base::Duration time) {
    const base::Time end = now() + time;
    while (now() < end) {
      if (startup->poll(now()) > WamProgress::kWaitingForIdle) break;
      emulator->advance_to_next_event(std::min(startup->deadline(), end));
    }
    return startup->poll(now());
  }
  WamProgress connect() {
    startup->connect(now());
    return talk();
  }
  WamProgress zero() {
    startup->zero(now());
    return talk();
  }
  std::string said() const { return startup->diagnostics().to_text(); }

  // ---- The cycle

  /// From E-stop to a driver whose arm is idle.
  void start(const WamDriver::Config& config = {}) {
    power_up();
    EXPECT_EQ(connect(), WamProgress::kDone) << said();
    EXPECT_EQ(zero(), WamProgress::kDone) << said();
    driver = WamDriver::make(host, startup->record(), config).value();
    driver->start(now());
    log.clear();
  }
  void start_active() {
    start();
    run(5);
    board().shift_activate();
    run(50);
    EXPECT_TRUE(driver->active());
    log.clear();
  }
  WamReading read() {
    driver->begin_reading(now());
    while (driver->poll(now()) == WamReading::kWaiting) {
      emulator->advance_to_next_event(driver->deadline());
    }
    return driver->reading();
  }
  /// Cycles of 2 ms, with the torques that were set last.
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      const base::Time next = now() + kPeriod;
      read();
      for (std::size_t motor = 0; motor < torques.size(); ++motor) {
        if (torques[motor]) driver->set_torque(motor, *torques[motor], now());
      }
      driver->send_torques(now());
      emulator->advance_to(next);
    }
  }
  /// How many cycles until there is a fault, at most `most`.
  int cycles_until_fault(int most) {
    int cycles = 0;
    while (driver->fault() == WamFault::kNone && cycles < most) {
      run(1);
      ++cycles;
    }
    return cycles;
  }

  std::unique_ptr<WamStartup> startup;
  std::optional<WamDriver> driver;
  std::array<std::optional<double>, kMostMotors> torques{};
};

}  // namespace armature::wam
