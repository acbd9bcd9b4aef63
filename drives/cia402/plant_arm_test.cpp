// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/plant_arm.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drives/cia402/emulated_bus.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

const std::string kWam = WAM "/wam7.urdf";
/// The upper arm is level: the shoulder carries what it can.
const std::vector<double> kLevel{0, 1.57, 0, 0, 0, 0, 0};

std::unique_ptr<EmulatedArm> level_wam() {
  auto arm = PlantArm{.file = kWam, .start = kLevel}.make();
  EXPECT_TRUE(arm) << arm.error();
  return std::move(arm).value();
}

TEST(PlantArm, StandsWhereItBegan) {
  const auto arm = level_wam();
  ASSERT_EQ(arm->joints(), 7U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(arm->position(i), 0.0);
}

TEST(PlantArm, IsHeldByItsBrakesAndFallsWithoutThem) {
  const auto arm = level_wam();
  arm->step(1s);
  EXPECT_NEAR(arm->position(1), 0.0, 1e-3);
  arm->push(1, 0.0);
  arm->step(200ms);
  EXPECT_GT(arm->position(1), 0.05);
  arm->hold(1);
  arm->step(200ms);
  EXPECT_NEAR(arm->velocity(1), 0.0, 1e-3);
}

TEST(PlantArm, HasOneJointFeelWhatAnotherDoes) {
  const auto arm = level_wam();
  arm->push(3, 0.0);
  arm->step(10ms);
  const double alone = arm->velocity(3);
  const auto other = level_wam();
  other->push(3, 0.0);
  other->push(1, -60.0);
  other->step(10ms);
  EXPECT_GT(std::abs(other->velocity(3) - alone), 1e-3);
}

TEST(PlantArm, SetsDrivesUpForTheirJoints) {
  const auto arm = level_wam();
  EXPECT_GT(arm->axis(0).inertia, arm->axis(6).inertia);
  EXPECT_GT(arm->axis(0).most_torque, arm->axis(6).most_torque);
  EXPECT_LT(arm->axis(1).low, -3.0);  // of the shoulder's 1.98 rad to both sides, from 1.57 on
  EXPECT_NEAR(arm->axis(1).high, 0.4, 0.05);
}

TEST(PlantArm, SaysWhatItCannotBeMadeOf) {
  EXPECT_THAT(PlantArm{.file = "no.urdf"}.make().error(), HasSubstr("no.urdf"));
  EXPECT_THAT((PlantArm{.file = kWam, .start = {0, 0}}.make().error()),
              HasSubstr("has 7 joints that move, and the start 2 numbers"));
}

TEST(PlantArm, HasAJointForEachDrive) {
  EmulatedBus::Config config;
  config.drives = 6;
  config.arm = level_wam();
  EXPECT_THAT(EmulatedBus::make(config).error(),
              HasSubstr("the arm has 7 joints, expected one for each of 6 drives"));
}

TEST(PlantArm, IsMovedTheSameHoweverTimePasses) {
  EmulatedBus::Config config;
  config.drives = 7;
  config.drive.brake = false;
  base::Time now{};
  config.clock = [&now] { return now; };
  std::vector<double> ends;
  for (const base::Duration by : {50us, 1000us}) {
    config.arm = level_wam();
    auto bus = EmulatedBus::make(config);
    ASSERT_TRUE(bus) << bus.error();
    for (now = base::Time{by}; now <= base::Time{100ms}; now += by) bus.value()->advance_to(now);
    ends.push_back(bus.value()->drive(1).axis().position());
  }
  EXPECT_GT(ends[0], 0.01);  // it has no brake
  EXPECT_NEAR(ends[0], ends[1], 1e-9);
}

}  // namespace
}  // namespace armature::cia402
