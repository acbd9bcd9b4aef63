// SPDX-License-Identifier: Apache-2.0
// Random paths of arms with 7, 6 and 4 joints, played with limits of joints: what the tool and the
// joints do, each 2 ms.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/cartesian/cartesian_plan.hpp"
#include "armature/control/taught/taught_player.hpp"

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using Vector = std::vector<double>;

constexpr double kPeriod_s = 0.002;
constexpr double kJointVelocity = 1.5;      // rad/s
constexpr double kJointAcceleration = 6.0;  // rad/s^2

/// The largest of each, along a whole motion.
struct Played {
  double off = 0.0;           ///< m, of the tool from its path
  double speed = 0.0;         ///< m/s
  double turning = 0.0;       ///< rad/s
  double acceleration = 0.0;  ///< m/s^2
  double joint_velocity = 0.0;
  double joint_acceleration = 0.0;
  bool slowed = false;  ///< by the limits of the joints
  double duration_s = 0.0;
};

class OfAnArm : public ::testing::Test {
 protected:
  OfAnArm(const char* file, const char* base, const char* tip, Vector start)
      : start_(std::move(start)) {
    base::Diagnostics diagnostics;
    arm_ = InverseKinematics::load(file, {.base_link = base, .tip_link = tip}, diagnostics);
    EXPECT_TRUE(arm_) << diagnostics.to_text();
    std::vector<OnlineTrajectory::Axis> axes;
    for (const JointLimits& each : arm_->limits()) {
      limits_.lower.push_back(each.lower);
      limits_.upper.push_back(each.upper);
      axes.push_back({kJointVelocity, kJointAcceleration, 60.0, each.lower, each.upper});
    }
    player_ = std::make_unique<TaughtPlayer>(TaughtPlayer::make({axes, 200.0}).value());
  }
  Pose here() { return arm_->pose_at(start_); }
  Pose moved(const PoseNumbers& by) {
    PoseNumbers numbers = numbers_of(here());
    for (std::size_t i = 0; i < 6; ++i) numbers[i] += by[i];
    return pose_of(numbers);
  }
  Pose somewhere(double far, double turn) {
    std::uniform_real_distribution<double> way(-far, far);
    std::uniform_real_distribution<double> angle(-turn, turn);
    return moved(
        {way(random_), way(random_), way(random_), angle(random_), angle(random_), angle(random_)});
  }
  Played play(const PosePath& path, const Vector& points, double speed, double stop_at_s = 1e9) {
    Played found;
    const auto answer = player_->play_from_here({start_}, points, speed, nullptr);
    EXPECT_TRUE(answer.accepted()) << to_text(answer.refusal);
    std::vector<Pose> poses;
    double nearest = 0.0;
    double passed_s = 0.0;
    while (player_->under_way() && passed_s < 300.0) {
      player_->step(2ms);
      passed_s += kPeriod_s;
      if (passed_s >= stop_at_s) player_->stop();
      const Vector joints(player_->positions().begin(), player_->positions().end());
      for (std::size_t i = 0; i < joints.size(); ++i) {
        EXPECT_GE(joints[i], limits_.lower[i]);
        EXPECT_LE(joints[i], limits_.upper[i]);
        found.joint_velocity = std::max(found.joint_velocity, std::abs(player_->velocities()[i]));
        found.joint_acceleration =
            std::max(found.joint_acceleration, std::abs(player_->accelerations()[i]));
      }
      poses.push_back(arm_->pose_at(joints));
      nearest = nearest_way(path, poses.back(), nearest);
      found.off = std::max(found.off, off_the_path(path, poses.back(), nearest));
      last_way_ = nearest;
    }
    found.slowed = player_->slowed();
    found.duration_s = passed_s;
    look_at(poses, found);
    return found;
  }
  /// From the last place on: the tool never goes back.
  static double nearest_way(const PosePath& path, const Pose& pose, double from) {
    double best = from;
    double least = 1e9;
    for (double way = from; way <= std::min(path.length(), from + 0.004); way += 0.0002) {
      const PoseDistance apart = distance(path.at(way), pose);
      const double off = apart.way + 0.1 * apart.angle;
      if (off < least) best = way;
      least = std::min(least, off);
    }
    return best;
  }
  static double off_the_path(const PosePath& path, const Pose& pose, double near) {
    double least = 1e9;
    for (double way = near - 0.003; way <= near + 0.003; way += 0.0002) {
      least = std::min(least, distance(path.at(way), pose).way);
    }
    return least;
  }
  /// Differences over 10 ms, so that the fit's noise of nanometres does not count.
  static void look_at(const std::vector<Pose>& poses, Played& found) {
    constexpr std::size_t kApart = 5;
    constexpr double kTime_s = kApart * kPeriod_s;
    for (std::size_t i = 2 * kApart; i < poses.size(); ++i) {
      const Pose& a = poses[i - 2 * kApart];
      const Pose& b = poses[i - kApart];
      const Pose& c = poses[i];
      found.speed = std::max(found.speed, distance(b, c).way / kTime_s);
      found.turning = std::max(found.turning, distance(b, c).angle / kTime_s);
      double squares = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        squares += std::pow(c.position[k] - 2.0 * b.position[k] + a.position[k], 2);
      }
      found.acceleration = std::max(found.acceleration, std::sqrt(squares) / (kTime_s * kTime_s));
    }
  }
  void expect_within_limits(const Played& found, double share_of_acceleration) {
    EXPECT_LT(found.off, limits_.max_deviation + 2e-4);
    EXPECT_LT(found.speed, 1.02 * limits_.velocity);
    EXPECT_LT(found.turning, 1.02 * limits_.turning);
    EXPECT_LE(found.joint_velocity, kJointVelocity + 1e-9);
    EXPECT_LE(found.joint_acceleration, kJointAcceleration + 1e-6);
    EXPECT_LT(found.acceleration, share_of_acceleration * limits_.acceleration);
  }
  /// @return whether it could be followed; a refusal has its place
  bool follow(const base::Result<PosePath>& path) {
    if (!path) {
      EXPECT_THAT(path.error(), ::testing::AnyOf(HasSubstr("turns back"), HasSubstr("one line")));
      return false;
    }
    const auto planned = plan_cartesian(*arm_, path.value(), start_, limits_);
    if (!planned) {
      EXPECT_THAT(planned.error(), HasSubstr(" m along the path of "));
      return false;
    }
    const Played found = play(path.value(), planned.value().points, planned.value().speed);
    expect_within_limits(found, found.slowed ? 1.7 : 1.1);
    EXPECT_LT(
        distance(arm_->pose_at(Vector(player_->positions().begin(), player_->positions().end())),
                 path.value().at(path.value().length()))
            .way,
        limits_.max_deviation);
    if (!found.slowed) EXPECT_NEAR(found.duration_s, planned.value().duration_s, 0.2);
    slowed_ += found.slowed ? 1 : 0;
    return true;
  }
  int follow_random_paths(int count, double far, double turn) {
    int followed = 0;
    for (int k = 0; k < count; ++k) {
      SCOPED_TRACE(k);
      const Pose one = somewhere(far, turn);
      const Pose two = somewhere(far, turn);
      const std::vector<Pose> poses{one, two, somewhere(far, turn)};
      followed += follow(PosePath::line(here(), one)) ? 1 : 0;
      followed += follow(PosePath::arc(here(), one.position, two)) ? 1 : 0;
      followed += follow(PosePath::through(here(), poses, 0.03)) ? 1 : 0;
    }
    return followed;
  }

  std::optional<InverseKinematics> arm_;
  CartesianLimits limits_;
  Vector start_;
  std::unique_ptr<TaughtPlayer> player_;
  std::mt19937 random_{17};
  double last_way_ = 0.0;
  int slowed_ = 0;
};

class OfSevenJoints : public OfAnArm {
 protected:
  OfSevenJoints() : OfAnArm(WAM7, "base", "tool", {0.2, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5}) {}
};
class OfSixJoints : public OfAnArm {
 protected:
  OfSixJoints() : OfAnArm(WAM7, "base", "link6", {0.2, 0.7, 0.3, 1.7, -0.5, 0.6}) {}
};
/// Seven but for the first: its wrist is singular where joints 5 and 7 turn about one axis.
class OfSixWithAWrist : public OfAnArm {
 protected:
  OfSixWithAWrist() : OfAnArm(WAM7, "link1", "tool", {0.7, 0.0, 1.7, 0.8, 0.4, 0.0}) {}
};
class OfFourJoints : public OfAnArm {
 protected:
  OfFourJoints() : OfAnArm(WAM4, "base", "tool", {0.2, 0.6, 0.0, 1.6}) {}
};

TEST_F(OfSevenJoints, RandomPathsAreFollowedWithinAllLimits) {
  const int followed = follow_random_paths(8, 0.2, 0.5);
  EXPECT_GT(followed, 12);
  EXPECT_LT(slowed_, followed) << "some are as fast as the tool may be";
}

TEST_F(OfSixJoints, RandomPathsAreFollowedWithinAllLimits) {
  EXPECT_GT(follow_random_paths(5, 0.1, 0.3), 6);
}

/// Its tool can only turn with its place: about the first joint's axis it can be led round.
TEST_F(OfFourJoints, AnArcAboutTheBaseIsFollowedAndOtherWaysAreRefusedWithTheirPlace) {
  Vector via = start_;
  Vector to = start_;
  via[0] += 0.4;
  to[0] += 0.8;
  ASSERT_TRUE(follow(PosePath::arc(here(), arm_->pose_at(via).position, arm_->pose_at(to))));
  const auto line = PosePath::line(here(), moved({0.1, 0.05, 0, 0, 0, 0}));
  EXPECT_THAT(plan_cartesian(*arm_, line.value(), start_, limits_).error(),
              HasSubstr(" m along the path of "));
}

TEST_F(OfSevenJoints, OnATightBendTheToolIsAsSlowAsItsAccelerationAsks) {
  const Pose via = moved({0, 0.02, 0.02, 0, 0, 0});
  const Pose to = moved({0, 0.04, 0, 0, 0, 0});
  const auto path = PosePath::arc(here(), via.position, to).value();
  ASSERT_NEAR(path.bend(0.0, 0.01), 50.0, 0.1) << "a radius of 2 cm";
  const auto planned = plan_cartesian(*arm_, path, start_, limits_).value();
  const Played found = play(path, planned.points, planned.speed);
  EXPECT_LT(found.speed, 1.03 * std::sqrt(0.8 * limits_.acceleration / 50.0)) << "0.13 m/s";
  EXPECT_GT(found.speed, 0.9 * std::sqrt(0.8 * limits_.acceleration / 50.0));
  EXPECT_LT(found.acceleration, 1.1 * limits_.acceleration);
}

TEST_F(OfSevenJoints, AStopAnywhereKeepsThePathAndBrakesWithALittleMore) {
  const std::vector<Pose> poses{moved({0, 0.12, 0, 0, 0, 0.3}), moved({0, 0.12, 0.12, 0, 0, 0}),
                                moved({0, 0, 0.12, 0.3, 0, 0})};
  const auto path = PosePath::through(here(), poses, 0.03).value();
  const auto planned = plan_cartesian(*arm_, path, start_, limits_).value();
  for (double stop_s = 0.5; stop_s < planned.duration_s; stop_s += 0.23) {
    SCOPED_TRACE(stop_s);
    const Played found = play(path, planned.points, planned.speed, stop_s);
    expect_within_limits(found, 1.7);
    EXPECT_LT(found.duration_s, stop_s + 1.0);
  }
}

TEST_F(OfSevenJoints, AJogIsEvenAndEndsBeforeAJointsLimit) {
  limits_.velocity = 0.1;
  const auto line = PosePath::line(here(), moved({0, 0, 1.0, 0, 0, 0})).value();
  const auto jog = plan_jog(*arm_, line, start_, limits_);
  ASSERT_TRUE(jog) << jog.error();
  EXPECT_GT(jog.value().way, 0.1);
  EXPECT_LT(jog.value().way, 1.0);
  EXPECT_THAT(jog.value().end, HasSubstr(" m along the path of 1.000 m, at x "));
  const auto way = PosePath::line(here(), line.at(jog.value().way)).value();
  const Played found = play(way, jog.value().plan.points, jog.value().plan.speed);
  expect_within_limits(found, 1.05);
  EXPECT_LT(found.speed, 0.101);
  EXPECT_GT(found.speed, 0.099);
  EXPECT_GT(last_way_, jog.value().way - 0.002) << "it gets there";
  for (std::size_t i = 0; i < start_.size(); ++i) start_[i] = player_->positions()[i];
  const auto back = PosePath::line(here(), line.at(0.0)).value();
  EXPECT_TRUE(plan_jog(*arm_, back, start_, limits_)) << "and back";
}

TEST_F(OfSixWithAWrist, AJogEndsBeforeASingularPlace) {
  int singular = 0;
  for (int k = 0; k < 40; ++k) {
    const auto line = PosePath::line(here(), somewhere(0.0, 1.2));
    const auto jog = plan_jog(*arm_, line.value(), start_, limits_);
    if (!jog || jog.value().end.find("the arm is singular: joint ") == std::string::npos) continue;
    ++singular;
    const auto path = PosePath::line(here(), line.value().at(jog.value().way)).value();
    const Played found = play(path, jog.value().plan.points, jog.value().plan.speed);
    limits_.turning = 10.0 * limits_.velocity;
    expect_within_limits(found, 1.1);
  }
  EXPECT_GT(singular, 0);
}

TEST_F(OfSevenJoints, JogsInEveryDirectionKeepAllLimitsWhereverTheyAreLetGo) {
  std::uniform_real_distribution<double> share(0.05, 1.0);
  int jogs = 0;
  for (int k = 0; k < 24; ++k) {
    SCOPED_TRACE(k);
    for (std::size_t i = 0; i < start_.size(); ++i) {
      start_[i] = limits_.lower[i] + share(random_) * (limits_.upper[i] - limits_.lower[i]) * 0.98;
    }
    limits_.velocity = 0.25 * share(random_);
    const bool turns = k % 2 == 0;
    const auto line = PosePath::line(here(), turns ? somewhere(0.0, 1.5) : somewhere(0.6, 0.0));
    const auto jog = plan_jog(*arm_, line.value(), start_, limits_);
    if (!jog) {
      EXPECT_THAT(jog.error(),
                  ::testing::AnyOf(HasSubstr(" m along the path of "), HasSubstr(" off the path")));
      continue;
    }
    ++jogs;
    const auto path = PosePath::line(here(), line.value().at(jog.value().way)).value();
    const double whole_s = jog.value().way / limits_.velocity;
    const Played found =
        play(path, jog.value().plan.points, jog.value().plan.speed, share(random_) * whole_s);
    limits_.turning = 10.0 * limits_.velocity;
    expect_within_limits(found, 1.1);
  }
  EXPECT_GT(jogs, 12);
}

}  // namespace
}  // namespace armature::control
