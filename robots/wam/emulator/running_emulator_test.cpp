// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/running_emulator.hpp"

#include <chrono>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/can/make_bus.hpp"
#include "armature/platform/clock.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

/// The emulated arm on a virtual bus, in real time, and a host.
class Running : public ::testing::Test {
 protected:
  Running() {
    RunningEmulator::Config config;
    config.emulator = Emulator::standard(7);
    std::ifstream urdf(description_of(wam7()));
    config.urdf.assign(std::istreambuf_iterator<char>(urdf), std::istreambuf_iterator<char>());
    config.socket = path;
    config.logs_frames = true;
    auto made = RunningEmulator::start(config);
    EXPECT_TRUE(made.ok()) << made.error();
    emulator = std::move(made).value();
    base::Diagnostics diagnostics;
    EXPECT_TRUE(host->open({}, diagnostics)) << diagnostics.to_text();
  }
  void say(const std::string& command) {
    const auto given = emulator->give(parse_emulator_command(command, 7).value());
    EXPECT_TRUE(given.ok()) << given.error();
  }
  template <typename Condition>
  static bool comes_true(const Condition& condition) {
    const base::Time end = platform::monotonic_now() + 10s;
    while (!condition()) {
      if (platform::monotonic_now() > end) return false;
      platform::sleep_until(platform::monotonic_now() + 1ms);
    }
    return true;
  }
  template <typename Condition>
  bool state_comes(const Condition& condition) {
    return comes_true([&] {
      bool seen = false;
      while (!seen && emulator->take_state(state)) seen = condition(state);
      return seen;
    });
  }
  /// Whether somebody answers a frame, which is sent again and again.
  bool answered(const std::string& frame) {
    return comes_true([&] {
      can::Arrival arrival;
      host->send(can::parse_frame(frame).value());
      return host->receive(arrival) == can::ReceiveStatus::kReceived;
    });
  }

  const std::string path =
      ::testing::TempDir() + "armature_running_emulator_" + std::to_string(::getpid());
  std::unique_ptr<RunningEmulator> emulator;
  std::unique_ptr<can::Bus> host = can::make_bus("virtual:" + path, kBitRate);
  EmulatorState state;
};

TEST_F(Running, BeginsInEstopAtHome) {
  ASSERT_TRUE(state_comes([](const EmulatorState&) { return true; }));
  EXPECT_EQ(state.mode, BoardMode::kEstop);
  EXPECT_EQ(state.motors, 7u);
  EXPECT_NEAR(state.position[1], wam7().home[1], 0.05);
}

TEST_F(Running, ObeysItsOperatorAndPowersThePucks) {
  say("release");
  say("idle");
  EXPECT_TRUE(state_comes([](const EmulatorState& each) {
    return each.mode == BoardMode::kIdle && each.pucks[6] == PuckState::kMonitor;
  }));
}

TEST_F(Running, ItsBoardAnswersAHostInAnotherPlaceAndFramesAreLogged) {
  EXPECT_TRUE(answered("00A#05"));
  std::vector<std::string> log;
  LoggedFrame logged;
  ASSERT_TRUE(comes_true([&] {
    while (emulator->take_frame(logged)) {
      log.emplace_back(can::to_text(logged.frame).view());
    }
    return log.size() >= 2;
  }));
  EXPECT_EQ(log[0], "00A#05");
  EXPECT_EQ(log[1].substr(0, 6), "546#85");
}

TEST_F(Running, TwoCannotHaveOneBus) {
  RunningEmulator::Config config;
  config.emulator = Emulator::standard(4);
  config.urdf = "";
  EXPECT_FALSE(RunningEmulator::start(config).ok()) << "there is no description";
  std::ifstream urdf(description_of(wam4()));
  config.urdf.assign(std::istreambuf_iterator<char>(urdf), std::istreambuf_iterator<char>());
  config.socket = path;
  const auto second = RunningEmulator::start(config);
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().find(path), std::string::npos) << second.error();
}

}  // namespace
}  // namespace armature::wam
