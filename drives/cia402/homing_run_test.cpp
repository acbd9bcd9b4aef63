// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/homing_run.hpp"

#include <gtest/gtest.h>

namespace armature::cia402 {
namespace {

constexpr std::uint16_t kAttained = status_bit::kAcknowledge | status_bit::kTargetReached;
constexpr std::int64_t kHm = 6;
constexpr std::int64_t kCsp = 8;

HomingRun::Seen off(std::int64_t mode) {
  return {.power = PowerState::kSwitchOnDisabled, .status = 0, .mode = mode};
}
HomingRun::Seen enabled(std::uint16_t status) {
  return {.power = PowerState::kOperationEnabled, .status = status, .mode = kHm};
}
void step(HomingRun& run, int cycles, const HomingRun::Seen& seen) {
  for (int k = 0; k < cycles; ++k) run.step(seen);
}
/// Its start bit has risen.
HomingRun moving(std::uint16_t status_before, bool moves = true) {
  HomingRun run(Mode::kCyclicPosition, moves);
  EXPECT_TRUE(run.begin());
  run.step(off(kHm));
  EXPECT_TRUE(run.step(enabled(status_before)).starts);
  return run;
}

TEST(HomingRun, NothingHomesThatWasNotToldTo) {
  HomingRun run(Mode::kCyclicTorque, true);
  const auto order = run.step(enabled(kAttained));
  EXPECT_EQ(order.mode, Mode::kCyclicTorque);
  EXPECT_FALSE(order.starts || order.enables);
  EXPECT_EQ(run.stage(), HomingStage::kIdle);
}

TEST(HomingRun, ADriveIsSwitchedOnOnceItShowsThatItIsInItsMode) {
  HomingRun run(Mode::kCyclicPosition, true);
  ASSERT_TRUE(run.begin());
  EXPECT_FALSE(run.begin()) << "it homes already";
  EXPECT_FALSE(run.step(off(kCsp)).enables);
  const auto order = run.step(off(kHm));
  EXPECT_TRUE(order.enables);
  EXPECT_FALSE(order.starts);
  EXPECT_EQ(order.mode, Mode::kHoming);
  EXPECT_FALSE(run.step(off(kHm)).enables) << "its goal is given once";
}

TEST(HomingRun, ItIsAtHomeWhenItHasAttainedAndStands) {
  HomingRun run = moving(0);
  step(run, 20, enabled(0));
  EXPECT_EQ(run.stage(), HomingStage::kUnderWay);
  step(run, 1, enabled(status_bit::kAcknowledge));
  EXPECT_EQ(run.stage(), HomingStage::kUnderWay) << "it does not stand yet";
  step(run, 1, enabled(kAttained));
  EXPECT_EQ(run.stage(), HomingStage::kAttained);
}

TEST(HomingRun, BitsOfTheRunBeforeDoNotEndOneThatMoves) {
  HomingRun run = moving(kAttained);
  step(run, 50, enabled(kAttained));
  EXPECT_EQ(run.stage(), HomingStage::kUnderWay);
  step(run, 1, enabled(0));
  step(run, 1, enabled(kAttained));
  EXPECT_EQ(run.stage(), HomingStage::kAttained);
}

TEST(HomingRun, ADriveThatIsAtHomeWhereItStandsNeedNotMove) {
  HomingRun run = moving(kAttained, false);
  step(run, 5, enabled(kAttained));
  EXPECT_EQ(run.stage(), HomingStage::kUnderWay);
  step(run, 10, enabled(kAttained));
  EXPECT_EQ(run.stage(), HomingStage::kAttained);
}

TEST(HomingRun, AnErrorBitAndALossOfPowerAreFailures) {
  HomingRun run = moving(0);
  step(run, 20, enabled(status_bit::kFollowingError));
  EXPECT_EQ(run.stage(), HomingStage::kFailed);
  HomingRun other = moving(0);
  step(other, 1, off(kHm));
  EXPECT_EQ(other.stage(), HomingStage::kFailed);
  EXPECT_FALSE(other.step(enabled(0)).starts) << "it does not begin again";
}

TEST(HomingRun, AStopDropsTheStartBitAndKeepsTheModeUntilItHasNoPowerToMove) {
  HomingRun run = moving(0);
  run.leave();
  auto order = run.step(enabled(0));
  EXPECT_FALSE(order.starts || order.enables);
  EXPECT_EQ(order.mode, Mode::kHoming);
  order = run.step({.power = PowerState::kQuickStopActive, .status = 0, .mode = kHm});
  EXPECT_EQ(order.mode, Mode::kHoming);
  EXPECT_EQ(run.step({.power = std::nullopt, .status = 0, .mode = kHm}).mode, Mode::kHoming);
  EXPECT_EQ(run.step(off(kHm)).mode, Mode::kCyclicPosition);
  EXPECT_EQ(run.stage(), HomingStage::kLeaving);
  EXPECT_FALSE(run.begin());
  run.step(off(kCsp));
  EXPECT_EQ(run.stage(), HomingStage::kIdle);
}

}  // namespace
}  // namespace armature::cia402
