// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/cycle_pdos.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/can/virtual_bus.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/cia402/emulated_drive.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using ::testing::HasSubstr;

/// The emulated drive's own EDS.
canopen::Eds eds_of_a_drive() {
  can::VirtualBus bus("can0", 1'000'000, [] { return base::Time{}; });
  const EmulatedDrive drive({}, bus.add_station("drive"), base::Time{});
  return canopen::describe(drive.device().dictionary(), "Armature", "Emulated drive");
}

std::string mistakes_of(const canopen::Eds& eds, const DriveWish& wish) {
  base::Diagnostics diagnostics;
  EXPECT_EQ(check_eds(eds, "drive.eds", wish, diagnostics), diagnostics.ok());
  return diagnostics.to_text();
}

DriveWish wish_for(Mode mode) {
  DriveWish wish;
  wish.name = "J1";
  wish.mode = mode;
  wish.with_velocity = true;
  return wish;
}

TEST(CheckEds, TheEmulatedDrivesOwnFileSuitsEachCyclicMode) {
  for (const Mode mode : {Mode::kCyclicPosition, Mode::kCyclicVelocity, Mode::kCyclicTorque}) {
    EXPECT_EQ(mistakes_of(eds_of_a_drive(), wish_for(mode)), "") << to_text(mode);
  }
}

TEST(CheckEds, AnotherMakersFileIsRefused) {
  DriveWish wish = wish_for(Mode::kCyclicPosition);
  wish.identity = canopen::Identity{.vendor = 0x99, .product = 1, .revision = 0, .serial = 5};
  EXPECT_EQ(mistakes_of(eds_of_a_drive(), wish),
            "drive.eds: error: drive 'J1': vendor is 0x402, expected 0x99 (give the EDS of this "
            "drive)\n");
}

TEST(CheckEds, AModeThatTheFileDoesNotHaveIsRefused) {
  canopen::Eds eds = eds_of_a_drive();
  eds.objects[object::kSupportedModes].value = supported_bit(Mode::kCyclicPosition);
  EXPECT_THAT(mistakes_of(eds, wish_for(Mode::kCyclicTorque)),
              HasSubstr("object 0x6502:00 has no mode CST (it has: CSP)"));
}

TEST(CheckEds, WhatCannotBeMappedIsNamed) {
  canopen::Eds eds = eds_of_a_drive();
  eds.objects[object::kTorque].mappable = false;
  eds.objects[object::kPosition].type = canopen::DataType::kInteger16;
  eds.objects.erase(object::kTargetPosition);
  const std::string mistakes = mistakes_of(eds, wish_for(Mode::kCyclicPosition));
  EXPECT_THAT(mistakes, HasSubstr("object 0x607A:00 is missing, and each cycle needs it"));
  EXPECT_THAT(mistakes, HasSubstr("object 0x6064:00 is INTEGER16, expected 32 bits"));
  EXPECT_THAT(mistakes, HasSubstr("object 0x6077:00 cannot be mapped to a TPDO"));
}

TEST(CyclePdos, FitIntoTheirFrames) {
  for (const Mode mode : {Mode::kCyclicPosition, Mode::kCyclicVelocity, Mode::kCyclicTorque}) {
    for (const auto& pdo : receive_pdos(wish_for(mode))) {
      EXPECT_TRUE(canopen::check_mapping(pdo.objects).ok());
    }
    for (const auto& pdo : transmit_pdos(wish_for(mode))) {
      EXPECT_TRUE(canopen::check_mapping(pdo.objects).ok());
    }
  }
}

}  // namespace
}  // namespace armature::cia402
