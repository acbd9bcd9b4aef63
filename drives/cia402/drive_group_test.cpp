// SPDX-License-Identifier: Apache-2.0
// A host with its group of emulated drives on a bus, cycle by cycle.
#include "drives/cia402/drive_group.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/canopen/test_link.hpp"
#include "drives/cia402/emulated_drive.hpp"
#include "drives/cia402/objects.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class Arm {
 public:
  explicit Arm(std::size_t drives, base::Duration cycle = 2ms) : cycle_(cycle) {
    for (std::size_t i = 0; i < drives; ++i) {
      EmulatedDrive::Config config;
      config.node = static_cast<canopen::NodeId>(i + 1);
      drives_.push_back(std::make_unique<EmulatedDrive>(config, link.station(), link.now()));
      link.add_party([drive = drives_.back().get()](base::Time now) { drive->advance_to(now); });
    }
    link.advance(1ms);
  }

  std::optional<DriveConfig> prepare(DriveWish wish) {
    wish.cycle = cycle_;
    canopen::SdoChannel channel(link, wish.node);
    return prepare_drive(channel, wish, diagnostics);
  }
  /// Prepares all for that mode, and starts them.
  void start(Mode mode, bool with_velocity = false) {
    std::vector<DriveConfig> configs;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      auto config = prepare({.node = static_cast<canopen::NodeId>(i + 1),
                             .name = "J" + std::to_string(i + 1),
                             .mode = mode,
                             .with_velocity = with_velocity});
      ASSERT_TRUE(config) << diagnostics.to_text();
      configs.push_back(*config);
    }
    auto made = DriveGroup::make(configs);
    ASSERT_TRUE(made) << made.error();
    group = std::make_unique<DriveGroup>(std::move(made).value());
    link.bus().send(canopen::nmt_frame(canopen::NmtCommand::kStart, canopen::kEveryNode));
    link.advance(1ms);
  }
  void cycle(int count = 1) {
    for (int i = 0; i < count; ++i) {
      can::Arrival arrival;
      while (link.bus().receive(arrival) == can::ReceiveStatus::kReceived) group->take(arrival);
      if (before_step) before_step();
      refused += group->step(link.bus(), link.now());
      link.advance(cycle_);
    }
  }
  void enable() {
    cycle(2);
    for (std::size_t i = 0; i < group->size(); ++i) group->set_goal(i, PowerGoal::kEnabled);
    cycle(8);
  }
  EmulatedDrive& drive(std::size_t i) { return *drives_[i]; }

  canopen::TestLink link;
  base::Diagnostics diagnostics;
  std::unique_ptr<DriveGroup> group;
  std::function<void()> before_step;
  std::size_t refused = 0;

 private:
  const base::Duration cycle_;
  std::vector<std::unique_ptr<EmulatedDrive>> drives_;
};

TEST(DriveGroup, BringsDrivesToOperationAndNothingMoves) {
  Arm arm(2);
  arm.start(Mode::kCyclicPosition);
  arm.cycle(5);
  EXPECT_EQ(arm.group->state(0).power, PowerState::kSwitchOnDisabled);
  arm.enable();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(arm.group->state(i).follows());
    EXPECT_NEAR(arm.drive(i).axis().position(), 0.0, 1e-4);
  }
}

TEST(DriveGroup, PositionsAreFollowed) {
  Arm arm(1);
  arm.start(Mode::kCyclicPosition);
  arm.enable();
  double target = 0.0;
  double most_error = 0.0;
  arm.before_step = [&] {
    target += 0.001;  // 0.5 rad/s
    arm.group->set_target(0, target);
    most_error = std::max(most_error, std::abs(target - arm.group->state(0).position));
  };
  arm.cycle(500);
  EXPECT_LT(most_error, 0.01);
  EXPECT_NEAR(arm.group->state(0).velocity, 0.5, 0.02);
  EXPECT_NEAR(arm.group->state(0).position, arm.drive(0).axis().position(), 0.002);
}

TEST(DriveGroup, VelocitiesAreFollowed) {
  Arm arm(1);
  arm.start(Mode::kCyclicVelocity, true);
  arm.enable();
  arm.group->set_target(0, -1.0);
  arm.cycle(200);
  EXPECT_NEAR(arm.drive(0).axis().velocity(), -1.0, 0.01);
  EXPECT_NEAR(arm.group->state(0).velocity, -1.0, 0.01);
}

TEST(DriveGroup, TorquesArePassedOn) {
  Arm arm(1);
  arm.start(Mode::kCyclicTorque, true);
  arm.enable();
  arm.group->set_target(0, 1.2);
  arm.cycle(50);
  EXPECT_NEAR(arm.drive(0).axis().torque(), 1.2, 0.03);
  EXPECT_NEAR(arm.group->state(0).effort, 1.2, 0.03);
  EXPECT_NEAR(arm.group->state(0).velocity, 10.0 * (1.0 - std::exp(-0.1)), 0.2)
      << "J v' = (1.2 - 0.2) N m - 0.1 N m s v, after 0.1 s";
}

TEST(DriveGroup, ATargetThatWasGivenBeforeEnablingDoesNotCount) {
  Arm arm(1);
  arm.start(Mode::kCyclicPosition);
  arm.cycle(2);
  arm.group->set_target(0, 1.0);
  arm.enable();
  EXPECT_TRUE(arm.group->state(0).enabled());
  EXPECT_NEAR(arm.drive(0).axis().position(), 0.0, 1e-4);
}

TEST(DriveGroup, AFaultIsLeftByTheOperatorsWordAloneAndNothingStartsAgain) {
  Arm arm(1);
  arm.start(Mode::kCyclicVelocity);
  arm.enable();
  arm.group->set_target(0, 1.0);
  arm.cycle(100);
  arm.drive(0).fail(canopen::emergency_code::kOvercurrent);
  arm.cycle(100);
  EXPECT_EQ(arm.group->state(0).power, PowerState::kFault);
  ASSERT_TRUE(arm.group->state(0).emergency);
  EXPECT_EQ(arm.group->state(0).emergency->code, 0x2310);
  EXPECT_NEAR(arm.drive(0).axis().velocity(), 0.0, 1e-9);
  arm.group->set_goal(0, PowerGoal::kEnabled);
  arm.cycle(100);
  EXPECT_EQ(arm.group->state(0).power, PowerState::kFault);
  arm.group->ask_reset(0);
  arm.cycle(100);
  EXPECT_EQ(arm.group->state(0).power, PowerState::kSwitchOnDisabled);
  EXPECT_FALSE(arm.group->state(0).emergency);
  arm.group->set_goal(0, PowerGoal::kEnabled);
  arm.cycle(10);
  EXPECT_TRUE(arm.group->state(0).enabled());
  EXPECT_NEAR(arm.drive(0).axis().velocity(), 0.0, 1e-9) << "the target from before is gone";
}

TEST(DriveGroup, AQuickStopBrakesAndEnds) {
  Arm arm(1);
  arm.start(Mode::kCyclicVelocity);
  arm.enable();
  arm.group->set_target(0, 2.0);
  arm.cycle(200);
  const double before = arm.drive(0).axis().position();
  arm.group->set_goal(0, PowerGoal::kQuickStop);
  arm.cycle(5);
  EXPECT_EQ(arm.group->state(0).power, PowerState::kQuickStopActive);
  arm.cycle(100);
  EXPECT_EQ(arm.group->state(0).power, PowerState::kSwitchOnDisabled);
  // v2 / 2a with 50 rad/s2, and two cycles until the drive knows.
  EXPECT_NEAR(arm.drive(0).axis().position() - before, 0.04 + 0.008, 0.01);
}

TEST(DriveGroup, ADriveThatHearsNoSyncFaults) {
  Arm arm(2);
  arm.start(Mode::kCyclicPosition);
  arm.enable();
  arm.drive(0).set_deaf_to_sync(true);
  arm.cycle(50);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kFault);
  EXPECT_EQ(arm.drive(1).power(), PowerState::kOperationEnabled);
  EXPECT_GE(arm.group->state(0).silent_cycles, 48u);
  EXPECT_EQ(arm.group->state(1).silent_cycles, 0u);
  ASSERT_TRUE(arm.group->state(0).emergency);
  EXPECT_EQ(arm.group->state(0).emergency->code, canopen::emergency_code::kSyncLost);
}

TEST(DriveGroup, WhenItStopsToCycleDrivesFaultByThemselves) {
  Arm arm(1);
  arm.start(Mode::kCyclicVelocity);
  arm.enable();
  arm.group->set_target(0, 1.0);
  arm.cycle(100);
  arm.link.advance(200ms);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kFault);
  EXPECT_EQ(arm.drive(0).axis().velocity(), 0.0);
}

TEST(DriveGroup, ADriveThatDoesNotAnswerIsStopped) {
  Arm arm(1);
  arm.start(Mode::kCyclicVelocity);
  arm.enable();
  arm.group->set_target(0, 1.0);
  arm.cycle(100);
  arm.drive(0).device().set_stuck_pdos(true);
  arm.cycle(5);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kOperationEnabled);
  arm.cycle(5);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kQuickStopActive);
  arm.cycle(90);
  EXPECT_NEAR(arm.group->state(0).silent_cycles, 100u, 2u);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kSwitchOnDisabled);
  arm.drive(0).device().set_stuck_pdos(false);
  arm.cycle(20);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kSwitchOnDisabled) << "until its goal is given anew";
}

TEST(DriveGroup, ADriveWhoseHeartbeatIsLostIsStopped) {
  Arm arm(1);
  arm.start(Mode::kCyclicPosition);
  arm.enable();
  arm.cycle(100);
  arm.drive(0).device().set_silent_heartbeat(true);
  arm.cycle(200);
  EXPECT_EQ(arm.group->state(0).presence, canopen::Presence::kLost);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kSwitchOnDisabled);
  arm.drive(0).device().set_silent_heartbeat(false);
  arm.cycle(200);
  EXPECT_EQ(arm.group->state(0).presence, canopen::Presence::kPresent);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kSwitchOnDisabled) << "until its goal is given anew";
}

TEST(DriveGroup, ARebootInMotionIsSeenAndTheDriveStaysOff) {
  Arm arm(1);
  arm.start(Mode::kCyclicVelocity);
  arm.enable();
  arm.group->set_target(0, 1.0);
  arm.cycle(100);
  arm.drive(0).reboot(arm.link.now());
  arm.cycle(100);
  EXPECT_EQ(arm.group->state(0).reboots, 1u);
  EXPECT_EQ(arm.drive(0).device().state(), canopen::NmtState::kPreOperational);
  arm.link.bus().send(canopen::nmt_frame(canopen::NmtCommand::kStart, canopen::kEveryNode));
  arm.cycle(100);
  EXPECT_EQ(arm.drive(0).power(), PowerState::kSwitchOnDisabled);
}

TEST(DriveGroup, SevenDrivesAtAMegabitHaveTheirTargetsFiveHundredTimesASecond) {
  Arm arm(7);
  arm.start(Mode::kCyclicPosition);
  arm.enable();
  arm.cycle(100);
  const auto before = arm.link.wire().counters();
  arm.cycle(500);
  const auto after = arm.link.wire().counters();
  EXPECT_EQ(arm.refused, 0u);
  // In a second: 500 SYNCs, 7 * 500 targets and answers, 7 * 10 heartbeats.
  EXPECT_NEAR(double(after.good - before.good), 500.0 * 15 + 70, 7);
  EXPECT_EQ(after.corrupted + after.lost + after.not_acknowledged, 0u);
  const double load = std::chrono::duration<double>(after.busy - before.busy).count();
  RecordProperty("bus_load", std::to_string(load));
  EXPECT_LT(load, 0.90);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_TRUE(arm.group->state(i).enabled());
    EXPECT_EQ(arm.group->state(i).silent_cycles, 0u);
  }
}

/// Of the time from the first target to the last answer.
TEST(DriveGroup, ACycleTakesNoLongerThanItsFramesButFivePercent) {
  Arm arm(7);
  arm.start(Mode::kCyclicPosition);
  arm.enable();
  base::Duration frames{};
  base::Time last{};
  arm.link.wire().set_tap([&](const can::WireEvent& event) {
    frames += event.end - event.begin;
    last = event.end;
  });
  base::Duration cycles{};
  for (int i = 0; i < 500; ++i) {
    const base::Time begin = arm.link.now();
    arm.cycle();
    cycles += last - begin;
  }
  const double ratio =
      std::chrono::duration<double>(cycles) / std::chrono::duration<double>(frames);
  RecordProperty("bus_time_ratio", std::to_string(ratio));
  EXPECT_LT(ratio, 1.05);
  EXPECT_GE(ratio, 1.0);
}

TEST(PrepareDrive, AnotherIdentityIsRefusedWithBothNumbers) {
  Arm arm(1);
  EXPECT_FALSE(arm.prepare(
      {.node = 1, .name = "J1", .identity = canopen::Identity{.vendor = 0x99, .product = 1}}));
  EXPECT_THAT(arm.diagnostics.to_text(),
              HasSubstr("drive 'J1', node 1: vendor is 0x402, expected 0x99"));
}

TEST(PrepareDrive, ANodeThatIsNotThereIsNamed) {
  Arm arm(1);
  EXPECT_FALSE(arm.prepare({.node = 9, .name = "J9"}));
  EXPECT_THAT(arm.diagnostics.to_text(), HasSubstr("drive 'J9', node 9: node 9 does not let"));
}

TEST(PrepareDrive, CycleAndModeAreWritten) {
  Arm arm(1, 4ms);
  ASSERT_TRUE(arm.prepare({.node = 1, .name = "J1"})) << arm.diagnostics.to_text();
  const auto& dictionary = arm.drive(0).device().dictionary();
  EXPECT_EQ(dictionary.number({0x1006, 0}), 4000);
  EXPECT_EQ(dictionary.number(object::kInterpolationTime), 4);
  EXPECT_EQ(dictionary.number(object::kInterpolationExponent), -3);
  EXPECT_EQ(dictionary.number(object::kMode), 8);
}

TEST(DriveGroup, AMissingObjectIsNamed) {
  DriveConfig config;
  config.node = 3;
  config.name = "J3";
  EXPECT_THAT(DriveGroup::make({config}).error(),
              HasSubstr("drive 'J3', node 3: no RPDO has 0x6040:00, the control word (map it)"));
}

}  // namespace
}  // namespace armature::cia402
