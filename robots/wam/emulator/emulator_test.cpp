// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator.hpp"

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/emulator/test_bench.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// What a driver could notice, each once.

TEST(Conformance, AnswersHaveTheirIdentifiersLengthsAndAZero) {
  Bench bench;
  bench.wake_up();
  for (int node = 1; node <= 7; ++node) {
    const std::string get = "00" + std::to_string(node) + "#";
    for (const char* property : {"05", "44"}) {
      const auto answers = bench.tell(get + property);
      ASSERT_THAT(answers, SizeIs(1));
      const can::Frame answer = can::parse_frame(answers[0]).value();
      EXPECT_EQ(answer.id, 0x406u + 32u * static_cast<std::uint32_t>(node));
      EXPECT_EQ(answer.size, std::string(property) == "05" ? 4 : 6);
      EXPECT_EQ(answer.data[1], 0);
    }
  }
}

TEST(Conformance, NoSetIsAcknowledged) {
  Bench bench;
  bench.wake_up();
  for (const char* set : {"001#AB00E803", "404#880000000000", "00A#B70005000000",
                          "00A#AA0001000000", "001#B00000000000", "401#AA00000000000000"}) {
    EXPECT_THAT(bench.tell(set), IsEmpty()) << set;
  }
}

TEST(Conformance, WithoutPowerTheBoardAloneAnswers) {
  Bench bench;
  std::vector<std::string> all;
  for (int node = 1; node <= kLastNode; ++node) {
    const auto frame = get_frame(to_node(node), 5);
    for (auto& answer : bench.tell(std::string(can::to_text(frame).view()))) {
      all.push_back(std::move(answer));
    }
  }
  EXPECT_THAT(all, ElementsAre("546#85000200"));
}

TEST(Conformance, TheMonitorHasItsElevenProperties) {
  Bench bench;
  bench.power_up();
  int answered = 0;
  for (int number = 0; number < 128; ++number) {
    const auto frame = get_frame(to_node(1), number);
    answered += static_cast<int>(bench.tell(std::string(can::to_text(frame).view())).size());
  }
  EXPECT_EQ(answered, 11);
}

TEST(Conformance, MonitorAndMainFirmwareHaveVersionsOfTheirOwn) {
  Bench bench;
  bench.power_up();
  EXPECT_THAT(bench.tell("001#00"), ElementsAre("426#80000C00"));
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#00"), ElementsAre("426#8000AF00"));
}

TEST(Conformance, PucksAreSilentWhileTheyWakeUp) {
  Bench bench;
  bench.power_up();
  bench.tell("400#85000200");
  for (int i = 0; i < 49; ++i) {
    EXPECT_THAT(bench.tell("400#05"), IsEmpty());
    bench.advance(8ms);
  }
}

TEST(Conformance, AGroupAnswersInTheOrderOfItsNodes) {
  Bench bench;
  bench.wake_up();
  EXPECT_THAT(bench.tell("404#30"),
              ElementsAre("423#800000", "443#800000", "463#800000", "483#800000", "4A3#800000",
                          "4C3#800000", "4E3#800000"));
  EXPECT_THAT(bench.tell("402#05"), ElementsAre("4A6#85000200", "4C6#85000200", "4E6#85000200"));
}

TEST(Conformance, PositionsHaveThreeBytes) {
  Bench bench;
  bench.wake_up();
  for (const auto& answer : bench.tell("404#30")) {
    EXPECT_EQ(can::parse_frame(answer).value().size, 3) << answer;
  }
}

TEST(Conformance, TorquesWorkInTorqueModeOnly) {
  Bench bench;
  bench.wake_up();
  bench.tell("401#AA0193F3804B3E70");
  bench.advance(100ms);
  EXPECT_EQ(bench.rotors.velocity(0), 0.0);
  bench.board().shift_activate();
  bench.advance(1ms);
  EXPECT_EQ(bench.rotors.velocity(0), 0.0);
  bench.tell("401#AA0193F3804B3E70");
  bench.advance(1ms);
  EXPECT_GT(bench.rotors.velocity(0), 0.0);
  EXPECT_LT(bench.rotors.velocity(1), 0.0);
}

TEST(Conformance, ModesOfMotorsChangeWithoutTheHost) {
  Bench bench;
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#08"), ElementsAre("426#88000000"));
  bench.board().shift_activate();
  bench.advance(1ms);
  EXPECT_THAT(bench.tell("001#08"), ElementsAre("426#88000200"));
  bench.board().fail(Monitor::kVelocity);
  bench.advance(1ms);
  EXPECT_THAT(bench.tell("001#08"), ElementsAre("426#88000000"));
}

TEST(Conformance, CountsAreTheFloorOfTheAngle) {
  Bench bench;
  bench.wake_up();
  bench.rotors.set_state(0, -1e-9, 0.0);
  EXPECT_THAT(bench.tell("001#30"), ElementsAre("423#BFFFFF"));
  bench.rotors.set_state(0, 2.0 * std::numbers::pi * 4095.999 / 4096.0, 0.0);
  EXPECT_THAT(bench.tell("001#30"), ElementsAre("423#800FFF"));
}

TEST(Conformance, ZeroSurvivesFaultsAndNoEstop) {
  Bench bench;
  bench.activate();
  bench.tell("00A#AA0001000000");
  bench.board().fail(Monitor::kTorque);
  bench.advance(1ms);
  EXPECT_THAT(bench.tell("00A#2A"), ElementsAre("546#AA000100"));
  bench.board().estop();
  bench.advance(1ms);
  EXPECT_THAT(bench.tell("00A#2A"), ElementsAre("546#AA000000"));
}

TEST(Conformance, PositionsAreKeptInIdle) {
  Bench bench;
  bench.activate();
  bench.tell("003#B000E08F0000");
  bench.board().shift_idle();
  bench.advance(1s);
  EXPECT_THAT(bench.tell("003#30"), ElementsAre("463#808FE0"));
}

TEST(Conformance, TheBoardSpeaksToAllByItself) {
  Bench bench;
  bench.wake_up();
  bench.board().shift_activate();
  bench.board().shift_idle();
  bench.advance(1ms);
  EXPECT_THAT(bench.take_others(), ElementsAre("540#880002000000", "540#880000000000"));
}

TEST(Conformance, TheBoardIsSilentAboutWhatItRefuses) {
  Bench bench;
  bench.wake_up();
  EXPECT_THAT(bench.tell("00A#880002000000"), IsEmpty());
  EXPECT_THAT(bench.tell("00A#FF0002000000"), IsEmpty());
  EXPECT_THAT(bench.tell("00A#08"), ElementsAre("546#88000100"));
}

// The emulator itself.

TEST(Emulator, ItsCycleTakesTheFramesOwnTime) {
  Bench bench;
  bench.activate();
  bench.tell("404#30");
  bench.send("404#30");
  bench.advance(2ms);
  ASSERT_THAT(bench.log, SizeIs(8));
  base::Duration frames{};
  for (const can::WireEvent& event : bench.log) frames += event.end - event.begin;
  EXPECT_EQ(bench.log.back().end - bench.log.front().begin, frames + 75us)
      << "answers follow each other without a gap";
}

TEST(Emulator, TwoEqualRunsAreEqual) {
  const auto run = [] {
    Bench bench;
    bench.activate();
    for (int i = 0; i < 50; ++i) {
      bench.send("404#30");
      bench.send("401#AA0193F3804B3E70");
      bench.advance(2ms);
    }
    return bench.take_others();
  };
  EXPECT_EQ(run(), run());
}

TEST(Emulator, BeginsWhenItIsTold) {
  auto config = Emulator::standard(4);
  config.begin = base::time_from_ns(5'000'000'000);
  Bench bench(config);
  EXPECT_EQ(bench.now(), config.begin);
  bench.wake_up();
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#85000200"));
}

TEST(Emulator, RefusesWhatIsNoArm) {
  Rotors rotors(4, {}, {});
  auto config = Emulator::standard(7);
  EXPECT_THAT(Emulator::make(config, rotors).error(),
              HasSubstr("7 pucks, expected one for each of 4"));
  config = Emulator::standard(4);
  config.pucks[2].node = 5;
  EXPECT_THAT(Emulator::make(config, rotors).error(),
              HasSubstr("emulated WAM on 'can0': puck of motor 3 is node 5, expected 3"));
  config = Emulator::standard(4);
  config.pucks[0].units_per_nm = 0;
  EXPECT_THAT(Emulator::make(config, rotors).error(),
              HasSubstr("units_per_nm 0, expected above 0"));
  Rotors five(5, {}, {});
  EXPECT_THAT(Emulator::make(config, five).error(), HasSubstr("5 motors, expected 4 or 7"));
}

TEST(Emulator, AnyFramesLeaveItAlive) {
  Bench bench;
  bench.keeps_log = false;
  bench.wake_up();
  bench.board().shift_activate();
  std::mt19937 random(1);
  const auto up_to = [&](unsigned most) { return static_cast<unsigned>(random() % (most + 1)); };
  for (int i = 0; i < 20'000; ++i) {
    can::Frame frame;
    const int to = static_cast<int>(up_to(10));
    frame.id = identifier({0, to, up_to(1) == 1});
    frame.size = static_cast<std::uint8_t>(up_to(8));
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(up_to(255));
    if (up_to(3) != 0) frame.data[1] = 0;
    if (frame.data[0] == 0x85 || frame.data[0] == 0x88) frame.data[2] = 2;  // stay awake
    bench.host.send(frame);
    bench.advance(150us);
    can::Arrival arrival;
    while (bench.host.receive(arrival) == can::ReceiveStatus::kReceived) {
    }
  }
  bench.advance(2s);
  bench.board().estop();
  bench.advance(1ms);
  bench.wake_up();
  bench.keeps_log = true;
  EXPECT_THAT(bench.tell("00A#05"), ElementsAre("546#85000200"));
  EXPECT_THAT(bench.tell("001#05"), ElementsAre("426#85000200"));
  for (std::size_t motor = 0; motor < 7; ++motor) {
    EXPECT_TRUE(std::isfinite(bench.rotors.angle(motor)));
  }
}

TEST(Rotors, MoveAsTheirClosedSolutionSays) {
  Rotors rotors(4, {}, {.friction = 2e-5, .braking = 1e-3});
  rotors.drive(0, 0.01);
  for (int i = 1; i <= 1000; ++i) rotors.advance_to(base::time_from_ns(i * 1'000'000));
  Rotors once(4, {}, {.friction = 2e-5, .braking = 1e-3});
  once.drive(0, 0.01);
  once.advance_to(base::time_from_ns(1'000'000'000));
  EXPECT_NEAR(rotors.angle(0), once.angle(0), 1e-9);
  EXPECT_NEAR(once.velocity(0), 0.01 / 2e-5 * (1.0 - std::exp(-2e-5 / 1.1631e-4)), 1e-9);
}

TEST(Rotors, ABrakedMotorComesToRest) {
  Rotors rotors(4, {}, {});
  rotors.set_state(0, 1.0, 100.0);
  rotors.advance_to(base::time_from_ns(5'000'000'000));
  EXPECT_NEAR(rotors.velocity(0), 0.0, 1e-9);
  EXPECT_NEAR(rotors.angle(0), 1.0 + 100.0 * 1.1631e-4 / 1e-3, 1e-9);
}

}  // namespace
}  // namespace armature::wam
