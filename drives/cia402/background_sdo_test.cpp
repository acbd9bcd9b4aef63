// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/background_sdo.hpp"

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/canopen/test_link.hpp"
#include "drives/cia402/drive_settings.hpp"
#include "drives/cia402/emulated_drive.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using Preparation = BackgroundSdo::Preparation;

class TwoDrives : public ::testing::Test {
 protected:
  void SetUp() override {
    for (canopen::NodeId node = 1; node <= 2; ++node) {
      EmulatedDrive::Config config;
      config.node = node;
      drives.push_back(std::make_unique<EmulatedDrive>(config, link.station(), link.now()));
      link.add_party([drive = drives.back().get()](base::Time now) { drive->advance_to(now); });
    }
    link.advance(1ms);
    std::vector<DriveConfig> configs;
    for (canopen::NodeId node = 1; node <= 2; ++node) {
      canopen::SdoChannel channel(link, node);
      auto config = prepare_drive(channel,
                                  {.node = node,
                                   .name = "J",
                                   .mode = Mode::kCyclicVelocity,
                                   .host = HostHeartbeat{127, 20ms, 60ms}},
                                  diagnostics);
      ASSERT_TRUE(config) << diagnostics.to_text();
      config->slow = {object::kCurrent, object::kEmulatedTemperature, {0x5fff, 1}};
      configs.push_back(*config);
    }
    group.emplace(DriveGroup::make(configs).value());
    background.emplace(*group, 10ms);
    link.bus().send(canopen::nmt_frame(canopen::NmtCommand::kStart, canopen::kEveryNode));
    link.advance(1ms);
    group->set_heartbeat(127, 20ms, link.now());
  }
  void cycle(int count) {
    for (int i = 0; i < count; ++i) {
      can::Arrival arrival;
      while (link.bus().receive(arrival) == can::ReceiveStatus::kReceived) {
        group->take(arrival);
        background->take(arrival.frame, arrival.time);
        if (arrival.frame.id == 0x581 || arrival.frame.id == 0x582) ++answers;
      }
      group->step(link.bus(), link.now());
      background->step(link.bus(), link.now());
      link.advance(2ms);
    }
  }
  canopen::NmtState nmt(std::size_t i) { return drives[i]->device().state(); }

  canopen::TestLink link;
  base::Diagnostics diagnostics;
  std::vector<std::unique_ptr<EmulatedDrive>> drives;
  std::optional<DriveGroup> group;
  std::optional<BackgroundSdo> background;
  int answers = 0;
};

TEST_F(TwoDrives, SlowNumbersComeOneAfterTheOther) {
  EXPECT_FALSE(background->number(0, 1));
  cycle(100);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(background->number(i, 0), 0) << "no current";
    EXPECT_EQ(background->number(i, 1), 250) << "25 degrees Celsius";
    EXPECT_FALSE(background->number(i, 2)) << "it has no such object";
  }
  EXPECT_LE(answers, 20) << "200 ms, one every 10 ms";
  EXPECT_GE(answers, 12);
}

TEST_F(TwoDrives, ADriveThatRebootedIsPreparedAsAtTheStart) {
  cycle(10);
  drives[0]->reboot(link.now());
  cycle(10);
  ASSERT_EQ(nmt(0), canopen::NmtState::kPreOperational);
  ASSERT_NE(drives[0]->device().dictionary().number(object::kMode), 9);
  background->prepare_again(0);
  EXPECT_EQ(background->preparation(0), Preparation::kUnderWay);
  cycle(100);
  EXPECT_EQ(background->preparation(0), Preparation::kDone);
  EXPECT_EQ(nmt(0), canopen::NmtState::kOperational);
  EXPECT_EQ(drives[0]->device().dictionary().number(object::kMode), 9);
  EXPECT_EQ(drives[0]->device().dictionary().number({0x1600, 2}), 0x60ff0020);
  EXPECT_EQ(drives[0]->device().dictionary().number(kConsumedHeartbeat), 127 << 16 | 60);
  EXPECT_EQ(group->state(0).silent_cycles, 0u);
}

TEST_F(TwoDrives, AnotherDriveInItsPlaceIsNotPrepared) {
  drives[0]->reboot(link.now());
  cycle(10);
  drives[0]->set_identity({.vendor = 0x402, .product = 1, .revision = 1, .serial = 99});
  background->prepare_again(0);
  cycle(100);
  EXPECT_EQ(background->preparation(0), Preparation::kRefused);
  EXPECT_EQ(background->refused_at(0), (canopen::Address{0x1018, 4}));
  EXPECT_EQ(nmt(0), canopen::NmtState::kPreOperational);
}

TEST_F(TwoDrives, WithoutTheirHostsHeartbeatDrivesStop) {
  cycle(2);
  for (std::size_t i = 0; i < 2; ++i) group->set_goal(i, PowerGoal::kEnabled);
  cycle(100);
  ASSERT_EQ(drives[0]->power(), PowerState::kOperationEnabled);
  group->set_heartbeat(127, 0ms, link.now());
  cycle(50);
  EXPECT_EQ(drives[0]->power(), PowerState::kFault);
  EXPECT_EQ(group->state(0).emergency->code, canopen::emergency_code::kHeartbeatLost);
}

/// 0x6007.
TEST_F(TwoDrives, ADriveThatWouldGoOnWithoutItsHostIsToldToFault) {
  for (const int found : {0, 2, 3}) {
    drives[0]->device().dictionary().set_number(object::kAbortConnection, found);
    canopen::SdoChannel channel(link, 1);
    ASSERT_TRUE(prepare_drive(channel,
                              {.node = 1,
                               .name = "J",
                               .mode = Mode::kCyclicVelocity,
                               .host = HostHeartbeat{127, 20ms, 60ms}},
                              diagnostics))
        << diagnostics.to_text();
    EXPECT_EQ(drives[0]->device().dictionary().number(object::kAbortConnection),
              found == 0 ? 1 : found);
  }
}

TEST_F(TwoDrives, ADriveThatKeepsGoingOnWithoutItsHostIsRefused) {
  auto& objects = drives[0]->device().dictionary();
  objects.set_number(object::kAbortConnection, 0);
  objects.set_check(object::kAbortConnection,
                    [](std::uint64_t) { return canopen::AbortCode::kInvalidValue; });
  canopen::SdoChannel channel(link, 1);
  EXPECT_FALSE(prepare_drive(channel,
                             {.node = 1,
                              .name = "J",
                              .mode = Mode::kCyclicVelocity,
                              .host = HostHeartbeat{127, 20ms, 60ms}},
                             diagnostics));
  EXPECT_THAT(
      diagnostics.to_text(),
      ::testing::HasSubstr("object 0x6007:00 is 0, so it goes on moving when it loses its host"));
}

TEST_F(TwoDrives, ADriveThatForgetsThatItIsToFaultWithoutItsHostIsRefused) {
  auto& objects = drives[0]->device().dictionary();
  link.add_party([&objects](base::Time) { objects.set_number(object::kAbortConnection, 0); });
  canopen::SdoChannel channel(link, 1);
  EXPECT_FALSE(prepare_drive(channel,
                             {.node = 1,
                              .name = "J",
                              .mode = Mode::kCyclicVelocity,
                              .host = HostHeartbeat{127, 20ms, 60ms}},
                             diagnostics));
  EXPECT_THAT(diagnostics.to_text(), ::testing::HasSubstr("it does not keep another value"));
}

TEST_F(TwoDrives, ADriveThatWouldGoOnWithoutItsHostSinceItLostItsPowerIsNotPrepared) {
  drives[0]->reboot(link.now());
  cycle(10);
  drives[0]->device().dictionary().set_number(object::kAbortConnection, 0);
  background->prepare_again(0);
  cycle(100);
  EXPECT_EQ(background->preparation(0), Preparation::kRefused);
  EXPECT_EQ(background->refused_at(0), object::kAbortConnection);
}

TEST_F(TwoDrives, ADriveDoesWhatItsOptionSaysWhenItLosesItsHost) {
  const std::array<std::pair<int, PowerState>, 3> kEnds{{{0, PowerState::kOperationEnabled},
                                                         {2, PowerState::kSwitchOnDisabled},
                                                         {3, PowerState::kSwitchOnDisabled}}};
  for (const auto& [option, end] : kEnds) {
    drives[1]->device().dictionary().set_number(object::kAbortConnection, option);
    group->set_heartbeat(127, 20ms, link.now());
    cycle(50);
    group->set_goal(1, PowerGoal::kEnabled);
    cycle(100);
    ASSERT_EQ(drives[1]->power(), PowerState::kOperationEnabled) << option;
    group->set_heartbeat(127, 0ms, link.now());
    cycle(50);
    EXPECT_EQ(drives[1]->power(), end) << option;
    group->set_goal(1, PowerGoal::kOff);
    cycle(50);
  }
}

TEST_F(TwoDrives, AHostThatEndsInGoodOrderIsNotMissed) {
  cycle(2);
  for (std::size_t i = 0; i < 2; ++i) group->set_goal(i, PowerGoal::kEnabled);
  cycle(100);
  background->end_heartbeat(link.bus(), link.now());
  group->set_heartbeat(127, 0ms, link.now());
  cycle(100);
  EXPECT_EQ(drives[0]->power(), PowerState::kOperationEnabled);
  EXPECT_EQ(drives[1]->power(), PowerState::kOperationEnabled);
}

}  // namespace
}  // namespace armature::cia402
