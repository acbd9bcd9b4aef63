// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/torque_watch.hpp"

#include <chrono>

#include <gtest/gtest.h>

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;
using Finding = TorqueWatch::Finding;

constexpr double kRated = 50.0;  // N m

/// A drive in mode torque from cycle to cycle.
class WatchedDrive : public ::testing::Test {
 protected:
  WatchedDrive() { drive.power = PowerState::kOperationEnabled; }
  Finding cycle(double target) {
    drive.time += 2ms;
    return watch.step(drive, target, kRated);
  }
  /// How many cycles until it is found.
  int until(Finding finding, double target, double growth, int most = 200) {
    for (int k = 0; k < most; ++k) {
      if (cycle(target + k * growth) == finding) return k + 1;
    }
    return 0;
  }

  TorqueWatch watch;
  DriveState drive{};
};

TEST_F(WatchedDrive, ThatGivesWhatItIsToldIsGood) {
  for (int k = 0; k < 1000; ++k) {
    drive.effort = 0.01 * k;
    drive.position += 0.001;
    ASSERT_EQ(cycle(0.01 * k + 0.5), Finding::kGood);
  }
}

TEST_F(WatchedDrive, ThatStandsAndHoldsMayTellTheSameForEver) {
  drive.effort = 7.0;
  for (int k = 0; k < 10'000; ++k) ASSERT_EQ(cycle(k % 2 == 0 ? 7.0 : 7.4), Finding::kGood);
}

TEST_F(WatchedDrive, ThatGivesNothingIsFoundAfterTenCycles) {
  drive.velocity = 0.1;
  for (int k = 0; k < 10; ++k) {
    drive.position += 0.001;
    ASSERT_EQ(cycle(5.0), Finding::kGood);
  }
  drive.position += 0.001;
  EXPECT_EQ(cycle(5.0), Finding::kDisobeys);
}

TEST_F(WatchedDrive, ThatTellsTheSameWhileItIsToldOtherTorquesIsFrozen) {
  drive.effort = 1.0;
  EXPECT_EQ(until(Finding::kFrozen, 1.0, 0.05), 22) << "ten to be told another, ten to answer";
}

TEST_F(WatchedDrive, ThatHasStoodForLongHasTenCyclesToAnswer) {
  drive.effort = 1.0;
  for (int k = 0; k < 1000; ++k) cycle(1.0);
  for (int k = 0; k < 10; ++k) ASSERT_EQ(cycle(2.0), Finding::kGood);
  drive.effort = 2.0;
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(cycle(2.0), Finding::kGood);
}

TEST_F(WatchedDrive, ThatDoesNotAnswerIsSomebodyElsesToJudge) {
  drive.effort = 1.0;
  for (int k = 0; k < 40; ++k) ASSERT_EQ(watch.step(drive, 1.0 + 0.05 * k, kRated), Finding::kGood);
}

TEST_F(WatchedDrive, ThatIsNotEnabledHasNothingToObey) {
  drive.power = PowerState::kSwitchedOn;
  for (int k = 0; k < 40; ++k) ASSERT_EQ(cycle(5.0 + k), Finding::kGood);
  drive.power = PowerState::kOperationEnabled;
  drive.effort = 5.0;
  EXPECT_EQ(cycle(5.0), Finding::kGood) << "it begins anew";
}

}  // namespace
}  // namespace armature::cia402
