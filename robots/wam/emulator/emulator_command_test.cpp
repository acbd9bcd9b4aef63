// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator_command.hpp"

#include <chrono>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// An arm of seven joints on a bus with a host that listens.
class EmulatorCommands : public ::testing::Test {
 protected:
  EmulatorCommands()
      : motors(made_arm(), base::Time{}),
        emulator(Emulator::make(Emulator::standard(7), motors).value()),
        host(emulator->bus().add_station("host")) {
    base::Diagnostics diagnostics;
    EXPECT_TRUE(host.open({}, diagnostics)) << diagnostics.to_text();
  }
  static ArmSimulation made_arm() {
    ArmSimulation::Config config;
    config.urdf_file = description_of(wam7());
    return ArmSimulation::load(wam7(), config).value();
  }
  void say(const std::string& line) {
    const auto command = parse_emulator_command(line, 7);
    ASSERT_TRUE(command.ok()) << command.error();
    command.value().apply({*emulator, motors, wam7()});
  }
  void advance(base::Duration time) { emulator->advance_to(emulator->now() + time); }
  /// How many frames answer this one.
  int answers_to(const std::string& frame) {
    drain();
    EXPECT_EQ(host.send(can::parse_frame(frame).value()), can::SendStatus::kSent);
    advance(3ms);
    return drain();
  }
  int drain() {
    int frames = 0;
    can::Arrival arrival;
    while (host.receive(arrival) == can::ReceiveStatus::kReceived) ++frames;
    return frames;
  }
  void power_up() {
    say("release");
    say("idle");
    advance(400ms);
  }
  static std::string mistake_in(const std::string& line) {
    const auto command = parse_emulator_command(line, 7);
    return command.ok() ? "none" : command.error();
  }

  ArmMotors motors;
  std::unique_ptr<Emulator> emulator;
  can::VirtualStation& host;
};

constexpr const char* kAskStatusOfPuck3 = "003#05";

TEST_F(EmulatorCommands, AreThePendantsKeys) {
  say("idle");
  EXPECT_EQ(emulator->board().mode(), BoardMode::kEstop) << "its button is pressed";
  say("release");
  say("idle");
  EXPECT_EQ(emulator->board().mode(), BoardMode::kIdle);
  say("activate");
  EXPECT_EQ(emulator->board().mode(), BoardMode::kActive);
  say("estop");
  EXPECT_EQ(emulator->board().mode(), BoardMode::kEstop);
}

TEST_F(EmulatorCommands, CarryTheArmHome) {
  Vector away = wam7().home;
  away[0] = 0.2;
  motors.carry_to(away);
  advance(1s);
  say(" home ");
  advance(1s);
  EXPECT_EQ(motors.arm().joint_position(0), wam7().home[0]);
}

TEST_F(EmulatorCommands, SilenceAPuckAndHealIt) {
  power_up();
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 1);
  say("fault puck 3 silent");
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 0);
  say("fault puck 3 heals");
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 1);
}

TEST_F(EmulatorCommands, LoseAnswersOfOnePuck) {
  power_up();
  say("fault puck 3 lose 2");
  EXPECT_EQ(answers_to("004#05"), 1);
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 0);
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 0);
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 1);
}

TEST_F(EmulatorCommands, SpoilAnswers) {
  power_up();
  say("fault puck 3 twice 1");
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 2);
  say("fault puck 3 delay 3.5");
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 0) << "it comes later than within 3 ms";
}

TEST_F(EmulatorCommands, TripTheBoardsMonitorsAndLowerItsSupply) {
  power_up();
  say("activate");
  say("fault board velocity");
  EXPECT_EQ(emulator->board().mode(), BoardMode::kIdle);
  EXPECT_EQ(emulator->board().pendant().level(Monitor::kVelocity), Level::kFault);
  say("fault board supply 20");
  advance(1ms);
  EXPECT_EQ(emulator->board().pendant().level(Monitor::kVoltage), Level::kFault);
}

TEST_F(EmulatorCommands, HaveAPuckTellAnotherFirmware) {
  say("fault puck 3 firmware 64");
  EXPECT_EQ(emulator->puck(2).properties().get(Property::kVers), 64);
  EXPECT_EQ(emulator->puck(2).properties().number(Property::kCts), 68) << "that of firmware 175";
  EXPECT_EQ(emulator->puck(1).properties().get(Property::kVers), 175);
}

TEST_F(EmulatorCommands, CutTheBus) {
  power_up();
  say("fault bus cut");
  EXPECT_EQ(answers_to(kAskStatusOfPuck3), 0);
  say("fault bus heals");
  advance(100ms);
  EXPECT_GE(answers_to(kAskStatusOfPuck3), 1);
}

TEST_F(EmulatorCommands, EachCommandThatIsListedIsUnderstood) {
  power_up();
  std::istringstream lines(emulator_commands());
  std::set<std::string> seen;
  for (std::string line; std::getline(lines, line);) {
    std::string command = line.substr(2, 34);
    for (const auto& [name, number] : {std::pair{" N", " 3"},
                                       {" COUNT", " 2"},
                                       {" MS", " 1.5"},
                                       {" VOLTS", " 48"},
                                       {" VERSION", " 64"}}) {
      if (const auto at = command.find(name); at != std::string::npos) {
        command.replace(at, std::string(name).size(), number);
      }
    }
    say(command);
    advance(1ms);
    seen.insert(command);
  }
  EXPECT_EQ(seen.size(), 29u);
}

TEST_F(EmulatorCommands, WhatHasFramesSentAgainNeedsABusWithABitRate) {
  for (const char* line : {"fault bus cut", "fault bus corrupt 3"}) {
    EXPECT_TRUE(parse_emulator_command(line, 7).value().needs_bit_rate) << line;
  }
  for (const char* line : {"fault bus lose 3", "fault bus heals", "fault puck 1 bus-off"}) {
    EXPECT_FALSE(parse_emulator_command(line, 7).value().needs_bit_rate) << line;
  }
}

TEST_F(EmulatorCommands, WhatIsWrongIsSaidWithWhatWasExpected) {
  EXPECT_EQ(mistake_in("activat"), "'activat' is not a command; did you mean 'activate'?");
  EXPECT_EQ(mistake_in("dance"), "'dance' is not a command; 'help' lists them all");
  EXPECT_EQ(mistake_in("fault puck 8 silent"),
            "'fault puck N silent': expected for N a puck of this arm, 1 to 7, found '8'");
  EXPECT_EQ(mistake_in("fault puck 2 lose"),
            "'fault puck N lose COUNT': expected for COUNT a whole number from 1 to 1000000, found "
            "'nothing'");
  EXPECT_EQ(mistake_in("fault board supply much"),
            "'fault board supply VOLTS': expected for VOLTS a number from 0 to 200, found 'much'");
  EXPECT_THAT(mistake_in("fault puck 2 lose 1.5"), HasSubstr("found '1.5'"));
  EXPECT_THAT(mistake_in("fault puck 2 delay nan"), HasSubstr("found 'nan'"));
  EXPECT_EQ(mistake_in("idle now"), "'idle': expected nothing more, found 'now'");
}

}  // namespace
}  // namespace armature::wam
