// SPDX-License-Identifier: Apache-2.0
#include "armature/control/homing/homing_motion.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::HasSubstr;
using Status = HomingMotion::Status;

constexpr double kPeriod = 0.005;

/// A joint that does what it is told, between two stops, with a switch below `-0.5`, and index
/// marks at -0.4 and each 0.3 from there.
struct Joint {
  HomingMotion motion;
  double way = 0.0;
  double low_stop = -10.0;
  std::function<bool(double)> closed = [](double at) { return at < -0.5; };
  std::function<double(double way, double velocity)> obey = [](double at, double velocity) {
    return at + velocity * kPeriod;
  };
  double farthest = 0.0;
  double fastest = 0.0;

  static double marks_below(double at) { return std::floor((at + 0.4) / 0.3); }

  Status run(double seconds = 60.0) {
    motion.begin(closed(way));
    double seen = way;
    Status status = Status::kGoesOn;
    for (double time = 0.0; time < seconds && status == Status::kGoesOn; time += kPeriod) {
      const double mark = -0.4 + 0.3 * std::max(marks_below(seen), marks_below(way));
      status = motion.step({.way = way,
                            .switch_closed = closed(way),
                            .index_passed = marks_below(seen) != marks_below(way),
                            .since_index = way - mark});
      seen = way;
      if (status == Status::kGoesOn) way = std::max(low_stop, obey(way, motion.velocity()));
      farthest = std::max(farthest, std::abs(way));
      fastest = std::max(fastest, std::abs(way - seen) / kPeriod);
    }
    return status;
  }
};

HomingMotion::Config config_of(HomeSign sign) {
  return {.sign = sign,
          .velocity = -0.2,
          .acceleration = 4.0,
          .travel = 1.0,
          .back_off = 0.05,
          .tolerance = 0.01,
          .lead = 0.01,
          .period_s = kPeriod};
}

Joint joint_that_looks_for(HomeSign sign) {
  return {.motion = HomingMotion::make(config_of(sign)).value()};
}

TEST(HomingMotion, FindsWhereTheSwitchOpensSlowly) {
  Joint joint = joint_that_looks_for(HomeSign::kSwitch);
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), -0.5, 0.04 * kPeriod + 1e-9) << "a fifth of the velocity";
  EXPECT_NEAR(joint.way, -0.5, 2e-3) << "it rests there";
  EXPECT_LE(joint.fastest, 0.2 + 1e-9);
  EXPECT_LT(joint.farthest, 0.52);
}

TEST(HomingMotion, FindsTheSameWhenItBeginsAtItsSwitch) {
  Joint joint = joint_that_looks_for(HomeSign::kSwitch);
  joint.closed = [](double way) { return way < 0.3; };
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), 0.3, 3e-4);
}

TEST(HomingMotion, FindsTheEdgeWhereItBeginsAlsoIfItOpensBeforeItMoves) {
  HomingMotion motion = HomingMotion::make(config_of(HomeSign::kSwitch)).value();
  motion.begin(true);
  Status status = Status::kGoesOn;
  for (int k = 0; k < 200 && status == Status::kGoesOn; ++k) status = motion.step({.way = 1e-4});
  EXPECT_EQ(status, Status::kHome);
  EXPECT_EQ(motion.found_at(), 1e-4);
}

TEST(HomingMotion, FindsTheEdgeOfACamThatIsShorterThanItsWayToBrake) {
  Joint joint = joint_that_looks_for(HomeSign::kSwitch);
  joint.closed = [](double way) { return way < -0.5 && way > -0.503; };
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), -0.5, 3e-4);
}

TEST(HomingMotion, FindsAnIndexMarkExactlyAlsoAtFullSpeed) {
  Joint joint = joint_that_looks_for(HomeSign::kIndex);
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), -0.1, 1e-12);
}

TEST(HomingMotion, FindsTheMarkBehindTheSwitch) {
  Joint joint = joint_that_looks_for(HomeSign::kSwitchThenIndex);
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), -0.4, 1e-12) << "and not one on the way there";
}

TEST(HomingMotion, FindsAHardStopAndComesAwayFromIt) {
  Joint joint = joint_that_looks_for(HomeSign::kHardStop);
  joint.low_stop = -0.7;
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), -0.7, 1e-9);
  EXPECT_NEAR(joint.way, -0.65, 6e-3) << "and as far as it takes to brake";
}

// --- what does not become home ---------------------------------------------------------------

TEST(HomingMotion, ASignThatNeverComesEndsItAtRestWithinItsTravel) {
  for (const HomeSign sign : {HomeSign::kIndex, HomeSign::kSwitch, HomeSign::kHardStop}) {
    Joint joint = joint_that_looks_for(sign);
    joint.closed = [](double) { return false; };
    joint.obey = [sign](double way, double velocity) {
      return way + velocity * kPeriod + (sign == HomeSign::kIndex && way > -0.01 ? 1e-9 : 0.0);
    };
    HomingMotion::Config config = config_of(sign);
    if (sign == HomeSign::kIndex) config.travel = 0.09;  // before the first mark
    if (sign == HomeSign::kIndex) config.back_off = 0.03;
    joint.motion = HomingMotion::make(config).value();
    EXPECT_EQ(joint.run(), Status::kNothingFound);
    EXPECT_LE(joint.farthest, config.travel - 0.009);
    EXPECT_GT(joint.farthest, config.travel - 0.03) << "it has looked there";
  }
}

TEST(HomingMotion, ASwitchThatStaysClosedEndsItWithinItsTravel) {
  Joint joint = joint_that_looks_for(HomeSign::kSwitch);
  joint.closed = [](double) { return true; };
  EXPECT_EQ(joint.run(), Status::kNothingFound);
  EXPECT_EQ(joint.motion.stage(), HomingMotion::Stage::kToEdge);
  EXPECT_LE(joint.farthest, 0.991);
}

TEST(HomingMotion, AMarkThatDoesNotComeBehindTheSwitchEndsIt) {
  Joint joint = joint_that_looks_for(HomeSign::kSwitchThenIndex);
  joint.motion.begin(false);
  Status status = Status::kGoesOn;
  for (int k = 0; k < 20'000 && status == Status::kGoesOn; ++k) {
    status = joint.motion.step({.way = joint.way, .switch_closed = joint.way < -0.5});
    if (status == Status::kGoesOn) joint.way += joint.motion.velocity() * kPeriod;
  }
  EXPECT_EQ(status, Status::kNothingFound);
  EXPECT_EQ(joint.motion.stage(), HomingMotion::Stage::kToIndex);
}

TEST(HomingMotion, AJointThatDoesNotMoveIsBlockedBeforeItIsToldFar) {
  for (const HomeSign sign : {HomeSign::kIndex, HomeSign::kSwitch}) {
    Joint joint = joint_that_looks_for(sign);
    joint.obey = [](double way, double) { return way; };
    EXPECT_EQ(joint.run(), Status::kBlocked);
    EXPECT_LT(std::abs(joint.motion.told()), 0.02);
    EXPECT_EQ(joint.motion.moved(), 0.0);
  }
}

TEST(HomingMotion, ASensorThatIsDeadIsNoHardStop) {
  Joint joint = joint_that_looks_for(HomeSign::kHardStop);
  joint.obey = [](double way, double) { return way; };
  EXPECT_EQ(joint.run(), Status::kBlocked) << "it does not come away";
  EXPECT_EQ(joint.motion.stage(), HomingMotion::Stage::kBackingOff);
}

TEST(HomingMotion, AStopThatIsElsewhereTheSecondTimeIsNone) {
  Joint joint = joint_that_looks_for(HomeSign::kHardStop);
  joint.obey = [&joint](double way, double velocity) {
    const bool again = joint.motion.stage() == HomingMotion::Stage::kFindingAgain;
    return std::max(again ? -0.72 : -0.7, way + velocity * kPeriod);
  };
  EXPECT_EQ(joint.run(), Status::kStopGaveWay);
  EXPECT_GT(joint.way, -0.715) << "as soon as it is beyond";
}

TEST(HomingMotion, AStopThatSlipsAwayFromWhoPushesIsNone) {
  Joint joint = joint_that_looks_for(HomeSign::kHardStop);
  joint.obey = [](double way, double velocity) {
    return way + (way < -0.5 ? 0.4 : 1.0) * velocity * kPeriod;
  };
  EXPECT_EQ(joint.run(), Status::kNothingFound);
  EXPECT_LE(joint.farthest, 1.0);
}

TEST(HomingMotion, AJointThatRunsAwayIsAstrayWithinAFewHundredths) {
  for (const double faster : {-3.0, 4.0}) {
    Joint joint = joint_that_looks_for(HomeSign::kSwitch);
    joint.obey = [faster](double way, double velocity) {
      return way + (way < -0.2 ? faster : 1.0) * velocity * kPeriod;
    };
    EXPECT_EQ(joint.run(), Status::kAstray);
    EXPECT_NEAR(joint.way, -0.2, 0.05);
  }
}

TEST(HomingMotion, OutsideItsTravelIsTheEnd) {
  Joint joint = joint_that_looks_for(HomeSign::kIndex);
  joint.motion.begin(false);
  EXPECT_EQ(joint.motion.step({.way = 1.01}), Status::kBeyond);
  EXPECT_EQ(joint.motion.step({.way = std::nan("")}), Status::kBeyond);
}

TEST(HomingMotion, AConfigurationSaysEveryFieldThatIsWrong) {
  const auto made = HomingMotion::make({});
  ASSERT_FALSE(made);
  for (const char* field :
       {"velocity", "acceleration", "travel", "back_off", "tolerance", "lead"}) {
    EXPECT_THAT(made.error(), HasSubstr(field));
  }
}

}  // namespace
}  // namespace armature::control
