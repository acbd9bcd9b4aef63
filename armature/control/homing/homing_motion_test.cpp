// SPDX-License-Identifier: Apache-2.0
#include "armature/control/homing/homing_motion.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

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
  double way = 1e-4;
  for (int k = 0; k < 200 && status == Status::kGoesOn; ++k) {
    status = motion.step({.way = way});
    way += motion.velocity() * kPeriod;
  }
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

TEST(HomingMotion, FindsTheMarkThatIsCloseBehindTheSwitch) {
  Joint joint = joint_that_looks_for(HomeSign::kSwitchThenIndex);
  joint.closed = [](double way) { return way < -0.4005; };
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), -0.4, 1e-12) << "and not the next one";
}

TEST(HomingMotion, FindsAHardStopAndComesAwayFromIt) {
  Joint joint = joint_that_looks_for(HomeSign::kHardStop);
  joint.low_stop = -0.7;
  ASSERT_EQ(joint.run(), Status::kHome);
  EXPECT_NEAR(joint.motion.found_at(), -0.7, 1e-9);
  EXPECT_NEAR(joint.way, -0.65, 6e-3) << "and as far as it takes to brake";
}

// --- with friction ---------------------------------------------------------------------------

/// A joint that an effort drives along the motion, with dry friction, a back-EMF, and counts of
/// 0.1 mrad; it stops at -0.7, and has a switch below -0.5.
struct StickyJoint {
  double stiffness = 300.0;
  double damping = 14.0;
  double most_effort = 6.0;
  double friction = 0.0;
  double velocity = -0.2;
  double back_emf = 0.0;
  double cam = 10.0;  ///< length of it, from -0.5 on

  double at = 0.0;
  double speed = 0.0;

  HomingMotion motion_to(HomeSign sign) const {
    HomingMotion::Config config = config_of(sign);
    config.velocity = velocity;
    config.travel = 1.3;
    config.lead = most_effort / stiffness;
    return HomingMotion::make(config).value();
  }
  void move(double effort) {
    constexpr int kSteps = 20;
    constexpr double kInertia = 0.25;
    for (int k = 0; k < kSteps; ++k) {
      const double driven = effort - back_emf * speed;
      if (speed == 0.0 && std::abs(driven) <= friction) continue;
      const double side = std::copysign(1.0, speed != 0.0 ? speed : driven);
      const double next = speed + (driven - side * friction) / kInertia * kPeriod / kSteps;
      speed = next * speed < 0.0 ? 0.0 : next;
      at += speed * kPeriod / kSteps;
      if (at < -0.7) speed = 0.0;
      at = std::max(at, -0.7);
    }
  }
  Status run(HomingMotion& motion) {
    motion.begin(false);
    double before = 0.0;
    for (double time = 0.0; time < 150.0; time += kPeriod) {
      const double way = std::round(at / 1e-4) * 1e-4;
      const Status status =
          motion.step({.way = way, .switch_closed = way < -0.5 && way > -0.5 - cam});
      if (status != Status::kGoesOn) return status;
      const double slower = motion.velocity() - (way - before) / kPeriod;
      before = way;
      move(std::clamp(stiffness * (motion.desired_way() - way) + damping * slower, -most_effort,
                      most_effort));
    }
    return Status::kGoesOn;
  }
};

/// After it has turned round, what drives it has to cross twice its friction first.
TEST(HomingMotion, FrictionIsNoHardStopAndNothingThatBlocks) {
  std::vector<StickyJoint> joints;
  for (const double friction : {0.0, 1.5, 3.0, 5.5}) joints.push_back({.friction = friction});
  for (const double stiffness : {8.0, 15.0, 30.0, 60.0, 150.0}) {
    joints.push_back({.stiffness = stiffness, .damping = 3.0, .most_effort = 3.0, .friction = 0.8});
    joints.push_back({.stiffness = stiffness,
                      .damping = 3.0,
                      .most_effort = 3.0,
                      .friction = 0.8,
                      .velocity = -0.05,
                      .back_emf = 4.0});
  }
  for (const StickyJoint& joint : joints) {
    SCOPED_TRACE(::testing::Message() << joint.stiffness << ", friction " << joint.friction
                                      << ", velocity " << joint.velocity);
    for (const HomeSign sign : {HomeSign::kHardStop, HomeSign::kSwitch}) {
      StickyJoint moved = joint;
      HomingMotion motion = moved.motion_to(sign);
      EXPECT_EQ(moved.run(motion), Status::kHome);
      EXPECT_NEAR(motion.found_at(), sign == HomeSign::kSwitch ? -0.5 : -0.7, 1e-3);
    }
  }
}

TEST(HomingMotion, FindsTheRightEdgeOfACamThatItPassesWhileItTurnsRound) {
  for (const double stiffness : {8.0, 15.0, 30.0, 150.0}) {
    for (const double cam : {0.003, 0.01, 0.02, 0.04}) {
      SCOPED_TRACE(::testing::Message() << stiffness << ", cam " << cam);
      StickyJoint joint{.stiffness = stiffness, .damping = 3.0, .friction = 0.1, .cam = cam};
      HomingMotion motion = joint.motion_to(HomeSign::kSwitch);
      EXPECT_EQ(joint.run(motion), Status::kHome);
      EXPECT_NEAR(motion.found_at(), -0.5, 1e-3);
    }
  }
}

TEST(HomingMotion, FrictionThatItMayNotOvercomeBlocksIt) {
  for (const HomeSign sign : {HomeSign::kHardStop, HomeSign::kSwitch}) {
    StickyJoint joint{.friction = 6.5};
    HomingMotion motion = joint.motion_to(sign);
    EXPECT_EQ(joint.run(motion), Status::kBlocked);
    EXPECT_EQ(joint.at, 0.0);
  }
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

/// It is stopped at -0.7, and the second time at `again`.
void stop_elsewhere(Joint& joint, double again) {
  joint.obey = [&joint, again](double way, double velocity) {
    const bool comes_again = joint.motion.stage() == HomingMotion::Stage::kFindingAgain;
    return std::max(comes_again ? again : -0.7, way + velocity * kPeriod);
  };
}

TEST(HomingMotion, AStopThatIsElsewhereTheSecondTimeIsNone) {
  Joint joint = joint_that_looks_for(HomeSign::kHardStop);
  stop_elsewhere(joint, -0.72);
  EXPECT_EQ(joint.run(), Status::kStopGaveWay);
  EXPECT_GT(joint.way, -0.715) << "as soon as it is beyond";
}

TEST(HomingMotion, AStopThatIsShortOfItTheSecondTimeIsNone) {
  Joint joint = joint_that_looks_for(HomeSign::kHardStop);
  stop_elsewhere(joint, -0.68);
  EXPECT_EQ(joint.run(), Status::kStopGaveWay);
}

/// While what drives it takes up its friction, too.
TEST(HomingMotion, AJointThatRunsAwayWhenItTurnsRoundIsAstray) {
  for (const double faster : {-3.0, 4.0}) {
    HomingMotion::Config config = config_of(HomeSign::kSwitch);
    config.lead = 0.3;
    config.patience_s = 0.3;
    Joint joint{.motion = HomingMotion::make(config).value()};
    joint.obey = [&joint, faster](double way, double velocity) {
      const bool turned = joint.motion.stage() == HomingMotion::Stage::kToEdge;
      return way + (turned ? faster : 1.0) * velocity * kPeriod;
    };
    bool is_closed = false;  // from there on
    joint.closed = [&is_closed](double way) { return is_closed = is_closed || way < -0.1; };
    EXPECT_EQ(joint.run(), Status::kAstray) << faster;
    EXPECT_NEAR(joint.way, -0.1, 0.06);
  }
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
