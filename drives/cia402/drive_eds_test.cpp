// SPDX-License-Identifier: Apache-2.0
// What is refused before anything moves: a drive that is not what its EDS or its host says.
#include <chrono>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/canopen/count_devices.hpp"
#include "drives/canopen/test_link.hpp"
#include "drives/cia402/bus_time.hpp"
#include "drives/cia402/compare_eds.hpp"
#include "drives/cia402/cycle_pdos.hpp"
#include "drives/cia402/emulated_drive.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class DriveBeforeStart : public ::testing::Test {
 protected:
  DriveBeforeStart() : drive(add_drive()), eds(describe()) { link.advance(1ms); }

  EmulatedDrive& add_drive() {
    drives_.push_back(
        std::make_unique<EmulatedDrive>(EmulatedDrive::Config{}, link.station(), link.now()));
    EmulatedDrive& added = *drives_.back();
    link.add_party([&added](base::Time now) { added.advance_to(now); });
    return added;
  }
  canopen::Eds describe() {
    canopen::Eds described =
        canopen::describe(drive.device().dictionary(), "Armature", "Emulated drive");
    described.identity = {.vendor = 0x402, .product = 1, .revision = 1, .serial = 0};
    return described;
  }
  std::string differences() {
    base::Diagnostics diagnostics;
    canopen::SdoChannel channel(link, 1);
    EXPECT_EQ(compare_with_eds(channel, eds, "drive.eds", wish, diagnostics), diagnostics.ok());
    return diagnostics.to_text();
  }
  std::string preparing() {
    base::Diagnostics diagnostics;
    canopen::SdoChannel channel(link, 1);
    static_cast<void>(prepare_drive(channel, wish, diagnostics));
    return diagnostics.to_text();
  }

 private:
  std::vector<std::unique_ptr<EmulatedDrive>> drives_;

 protected:
  canopen::TestLink link;
  EmulatedDrive& drive;
  canopen::Eds eds;
  DriveWish wish{.node = 1, .name = "J1"};
};

TEST_F(DriveBeforeStart, IsWhatItsOwnFileSays) { EXPECT_EQ(differences(), ""); }

TEST_F(DriveBeforeStart, AnotherDrivesFileIsRefusedWithBothNumbers) {
  eds.identity.product = 7;
  EXPECT_EQ(differences(),
            "drive.eds: error: drive 'J1', node 1: product 0x1018:02 is 0x1, and its EDS says 0x7 "
            "(give the EDS of this drive and of its firmware)\n");
}

TEST_F(DriveBeforeStart, AnObjectThatTheFileAloneHasIsNamed) {
  eds.objects[{0x60fd, 0}] = {};
  eds.objects[object::kMode].type = canopen::DataType::kInteger16;
  eds.objects[{0x608f, 1}].type = canopen::DataType::kUnsigned16;
  const std::string text = differences();
  EXPECT_THAT(text, HasSubstr("object 0x6060:00 'Modes of operation' has 1 bytes, and its EDS says "
                              "INTEGER16"));
  EXPECT_THAT(text, HasSubstr("object 0x608F:01"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("0x60FD"))) << "nobody uses it";
}

TEST_F(DriveBeforeStart, AnObjectThatTheDriveLacksIsNamed) {
  wish.with_velocity = true;
  eds.objects[object::kPolarity].name = "not used";
  ASSERT_EQ(differences(), "");
  wish.host = HostHeartbeat{.node = 127, .period = 100ms, .timeout = 300ms};
  ASSERT_EQ(differences(), "");
  eds.objects[{0x1016, 1}].name = "Consumer heartbeat";
  eds.objects[{0x1016, 1}].type = canopen::DataType::kUnsigned64;
  EXPECT_THAT(differences(), HasSubstr("'Consumer heartbeat' has 4 bytes"));
}

TEST_F(DriveBeforeStart, AMappingThatTheDriveDoesNotTakeIsToldBesideTheWantedOne) {
  wish.mode = Mode::kCyclicVelocity;
  drive.device().dictionary().set_check(
      {0x1600, 0}, [](std::uint64_t) { return canopen::AbortCode::kReadOnly; });
  EXPECT_THAT(preparing(), HasSubstr("drive 'J1', node 1: RPDO 1 has 0x6040:00, 0x607A:00, "
                                     "expected 0x6040:00, 0x60FF:00: node 1 does not let "
                                     "0x1600:00 be written"));
}

TEST_F(DriveBeforeStart, TwoWithOneNumberAnswerTwice) {
  EXPECT_EQ(canopen::count_devices(link, 1), 1);
  EXPECT_EQ(canopen::count_devices(link, 2), 0);
  add_drive();
  link.advance(1ms);
  EXPECT_EQ(canopen::count_devices(link, 1), 2);
}

TEST_F(DriveBeforeStart, WhatIsWrittenHasToBeWithinTheFilesLimits) {
  eds.objects[{0x1006, 0}].low = 4000;
  base::Diagnostics diagnostics;
  EXPECT_FALSE(check_eds(eds, "drive.eds", wish, diagnostics));
  EXPECT_THAT(diagnostics.to_text(),
              HasSubstr("would be 2000, and its least value is 4000 (choose another period, "
                        "heartbeat or mode)"));
}

/// 2 x 7 frames of PDOs, SYNC, and a fiftieth of seven heartbeats.
TEST(BusTime, IsThatOfTheLongestFrames) {
  const std::vector<DriveWish> seven(7);
  EXPECT_EQ(cycle_bus_time(seven, 1'000'000), 55us + 7 * (115us + 135us) + 9us);
  EXPECT_EQ(cycle_bus_time(seven, 500'000), 2 * cycle_bus_time(seven, 1'000'000));
  EXPECT_LT(cycle_bus_time(seven, 1'000'000), 2ms);
}

}  // namespace
}  // namespace armature::cia402
