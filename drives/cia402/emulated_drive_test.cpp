// SPDX-License-Identifier: Apache-2.0
// Modes that are no cyclic ones, and what an operator of the emulator types.
#include "drives/cia402/emulated_drive.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/canopen/nmt.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/canopen/test_link.hpp"
#include "drives/cia402/emulated_bus.hpp"
#include "drives/cia402/emulator_command.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using canopen::DataType;
using ::testing::HasSubstr;

/// A drive that is commanded by SDO alone.
class OneDrive : public ::testing::Test {
 protected:
  OneDrive() {
    link_.add_party([this](base::Time now) { drive_.advance_to(now); });
    link_.advance(1ms);
    link_.bus().send(canopen::nmt_frame(canopen::NmtCommand::kStart, canopen::kEveryNode));
    link_.advance(1ms);
  }
  void write(canopen::Address address, DataType type, std::int64_t value) {
    const auto written = channel_.write(address, type, value);
    ASSERT_TRUE(written) << written.error();
  }
  void control(std::uint16_t word) { write(object::kControlWord, DataType::kUnsigned16, word); }
  void enable(Mode mode) {
    write(object::kMode, DataType::kInteger8, static_cast<int>(mode));
    for (const std::uint16_t word : std::array<std::uint16_t, 3>{0x06, 0x07, 0x0f}) control(word);
    ASSERT_EQ(drive_.power(), PowerState::kOperationEnabled);
  }
  std::uint16_t status() {
    return static_cast<std::uint16_t>(
        channel_.read(object::kStatusWord, DataType::kUnsigned16).value());
  }

  canopen::TestLink link_;
  EmulatedDrive drive_{{}, link_.station(), link_.now()};
  canopen::SdoChannel channel_{link_, 1};
};

TEST_F(OneDrive, ProfilePositionMovesToItsSetPointWithinItsLimits) {
  enable(Mode::kProfilePosition);
  write(object::kTargetPosition, DataType::kInteger32, drive_.scaling().raw_position(1.0));
  control(0x1f);
  EXPECT_NE(status() & status_bit::kAcknowledge, 0);
  EXPECT_EQ(status() & status_bit::kTargetReached, 0);
  double fastest = 0.0;
  for (int i = 0; i < 1500; ++i) {
    link_.advance(1ms);
    fastest = std::max(fastest, drive_.axis().velocity());
  }
  EXPECT_NEAR(drive_.axis().position(), 1.0, 0.002);
  EXPECT_NEAR(fastest, 1.0, 0.05) << "its profile velocity";
  EXPECT_NE(status() & status_bit::kTargetReached, 0);
}

TEST_F(OneDrive, ASetPointCountsWhenItsBitRises) {
  enable(Mode::kProfilePosition);
  write(object::kTargetPosition, DataType::kInteger32, drive_.scaling().raw_position(1.0));
  link_.advance(500ms);
  EXPECT_NEAR(drive_.axis().position(), 0.0, 1e-3);
}

TEST_F(OneDrive, HaltStopsItAndItGoesOn) {
  enable(Mode::kProfileVelocity);
  write(object::kTargetVelocity, DataType::kInteger32, drive_.scaling().raw_velocity(0.8));
  link_.advance(300ms);
  EXPECT_NEAR(drive_.axis().velocity(), 0.8, 0.02);
  control(0x10f);
  link_.advance(300ms);
  EXPECT_NEAR(drive_.axis().velocity(), 0.0, 0.01);
  EXPECT_EQ(drive_.power(), PowerState::kOperationEnabled);
  control(0x0f);
  link_.advance(300ms);
  EXPECT_NEAR(drive_.axis().velocity(), 0.8, 0.02);
}

TEST_F(OneDrive, HomesWhereItIs) {
  write(object::kHomeOffset, DataType::kInteger32, 1000);
  enable(Mode::kHoming);
  control(0x1f);
  link_.advance(50ms);
  EXPECT_NE(status() & status_bit::kFollowsCommand, 0) << "homing attained";
  EXPECT_NEAR(static_cast<double>(channel_.read(object::kPosition, DataType::kInteger32).value()),
              1000, 1);
}

TEST_F(OneDrive, HomesAtItsLimitSwitch) {
  write(object::kHomingMethod, DataType::kInteger8, 17);
  write(object::kHomingSpeed, DataType::kUnsigned32, drive_.scaling().raw_velocity(2.0));
  enable(Mode::kHoming);
  control(0x1f);
  link_.advance(3s);
  EXPECT_NE(status() & status_bit::kFollowsCommand, 0) << "homing attained";
  const auto position = channel_.read(object::kPosition, DataType::kInteger32).value();
  EXPECT_NEAR(drive_.scaling().position(position), drive_.axis().position() + 3.0, 1e-4);
}

/// The motor turns a hundred times for a turn of the shaft.
constexpr double kIndexPitch = 2.0 * 3.14159265358979 / 100.0;

TEST_F(OneDrive, HomesAtTheNextIndex) {
  for (const int method : {33, 34}) {
    write(object::kHomingMethod, DataType::kInteger8, method);
    enable(Mode::kHoming);
    const double before = drive_.axis().position();
    control(0x1f);
    link_.advance(3s);
    EXPECT_NE(status() & status_bit::kFollowsCommand, 0) << "homing attained";
    const double position =
        drive_.scaling().position(channel_.read(object::kPosition, DataType::kInteger32).value());
    const double home = drive_.axis().position() - position;
    EXPECT_NEAR(std::remainder(home, kIndexPitch), 0.0, 1e-4);
    EXPECT_EQ(home < before, method == 33);
    control(0x06);
    enable(Mode::kNone);
  }
}

TEST_F(OneDrive, HomesAtTheIndexBehindItsLimitSwitch) {
  for (const int method : {1, 2}) {
    write(object::kHomingMethod, DataType::kInteger8, method);
    write(object::kHomingSpeed, DataType::kUnsigned32, drive_.scaling().raw_velocity(2.0));
    enable(Mode::kHoming);
    control(0x1f);
    link_.advance(12s);
    EXPECT_NE(status() & status_bit::kFollowsCommand, 0) << "homing attained";
    const double position =
        drive_.scaling().position(channel_.read(object::kPosition, DataType::kInteger32).value());
    const double home = drive_.axis().position() - position;
    EXPECT_NEAR(std::remainder(home, kIndexPitch), 0.0, 1e-4);
    EXPECT_LT(std::abs(home), 3.0) << "back from the switch";
    EXPECT_GT(std::abs(home), 3.0 - kIndexPitch);
    EXPECT_EQ(home < 0.0, method == 1);
    control(0x06);
    enable(Mode::kNone);
  }
}

TEST_F(OneDrive, RefusesModesAndHomingMethodsThatItDoesNotHave) {
  EXPECT_THAT(channel_.write(object::kMode, DataType::kInteger8, 7).error(),
              HasSubstr("invalid value"));
  EXPECT_THAT(channel_.write(object::kHomingMethod, DataType::kInteger8, 3).error(),
              HasSubstr("invalid value"));
}

TEST_F(OneDrive, AnAxisThatDoesNotFollowIsAFault) {
  enable(Mode::kProfilePosition);
  write(object::kMostTorque, DataType::kUnsigned16, 0);
  write(object::kTargetPosition, DataType::kInteger32, drive_.scaling().raw_position(1.0));
  control(0x1f);
  link_.advance(1s);
  EXPECT_EQ(drive_.power(), PowerState::kFault);
  EXPECT_EQ(channel_.read(object::kErrorCode, DataType::kUnsigned16).value(), 0x8611);
}

/// Three drives, and what is typed.
class Typed : public ::testing::Test {
 protected:
  std::string give(const std::string& line) {
    const auto given = give_command(*drives_, line, base::Time{});
    return given ? given.value() : given.error();
  }
  EmulatedBus::Config config() {
    EmulatedBus::Config config;
    config.drives = 3;
    config.first_node = 5;
    config.clock = [] { return base::Time{}; };
    return config;
  }
  std::unique_ptr<EmulatedBus> drives_ = EmulatedBus::make(config()).value();
};

TEST_F(Typed, AFaultIsTheNamedDrivesOwn) {
  EXPECT_EQ(give("fail 6 0x2310"), "");
  drives_->advance_to(base::Time{} + 2s);
  EXPECT_EQ(drives_->find(5)->power(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(drives_->find(6)->power(), PowerState::kFault);
  EXPECT_THAT(give("state"), HasSubstr("node 6: pre-operational, fault, none, 0.0000 rad"));
}

TEST_F(Typed, AnotherIdentityIsTold) {
  EXPECT_EQ(give("identity 7 0x99 5"), "");
  EXPECT_EQ(drives_->find(7)->device().dictionary().number({0x1018, 1}), 0x99);
}

TEST_F(Typed, WhatIsWrongIsSaid) {
  EXPECT_THAT(give("fail 9"), HasSubstr("no drive has node 9, expected 5 to 7"));
  EXPECT_THAT(give("explode 5"), HasSubstr("'explode 5' is not understood; expected one of"));
  EXPECT_THAT(give("fail 5 0x12345"), HasSubstr("is not understood"));
  EXPECT_THAT(give("fail x"), HasSubstr("is not understood"));
  EXPECT_EQ(give(""), "");
}

TEST(EmulatedBus, NodesBeyond127AreRefused) {
  EmulatedBus::Config config;
  config.drives = 3;
  config.first_node = 126;
  EXPECT_THAT(EmulatedBus::make(config).error(),
              HasSubstr("expected nodes from 1 to 127, found 126 to 128"));
}

}  // namespace
}  // namespace armature::cia402
