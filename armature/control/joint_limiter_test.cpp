// SPDX-License-Identifier: Apache-2.0
#include "armature/control/joint_limiter.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/seconds.hpp"
#include "armature/control/trapezoid.hpp"

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using Status = JointLimiter::Status;
using Measured = JointLimiter::Measured;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array kNotFinite{kNan, kInfinity, -kInfinity};

/// A joint of Janus at 100 Hz.
const JointLimiter::Config kJoint{.lower = -0.5,
                                  .upper = 4.5,
                                  .max_velocity = 1.0,
                                  .max_acceleration = 5.0,
                                  .max_effort = 12.0,
                                  .period = 10ms};
constexpr double kPeriod = 0.01;
constexpr double kStep = 5.0 * kPeriod;  ///< of velocity

JointLimiter make_armed(double position, const JointLimiter::Config& config = kJoint) {
  JointLimiter limiter = JointLimiter::make(config).value();
  EXPECT_TRUE(limiter.arm({position, 0.0}));
  return limiter;
}

/// Whether a joint that moved with `velocity` to `position` can be stopped before its limits by
/// steps of the largest acceleration: tried, not calculated.
bool can_stop(const JointLimiter::Config& config, double position, double velocity) {
  const double period = std::chrono::duration<double>(config.period).count();
  const double step = config.max_acceleration * period;
  while (std::abs(velocity) > step) {
    velocity -= std::copysign(step, velocity);
    position += velocity * period;
  }
  const double tolerance = 1e-5 * step * period + 1e-12;
  return position <= config.upper + tolerance && position >= config.lower - tolerance;
}

TEST(JointLimiter, PassesWhatKeepsToTheLimits) {
  JointLimiter limiter = make_armed(0.0);
  // To the very limit, with all the velocity and acceleration there is: 4.5 m in 4.7 s.
  const Trapezoid motion = Trapezoid::rest_to_rest(0.0, 4.5, 4.7, 0.2 / 4.7);
  for (int k = 1; k <= 500; ++k) {
    const double command = motion.at(k * kPeriod).position;
    const auto limited = limiter.step_position({}, command);
    ASSERT_EQ(limited.status, Status::kPassed) << "at " << k * kPeriod << " s";
    ASSERT_DOUBLE_EQ(limited.value, command);
  }
  EXPECT_EQ(limiter.counts().position + limiter.counts().velocity, 0u);
  EXPECT_EQ(limiter.counts().acceleration, 0u);
}

TEST(JointLimiter, AJumpOfTheCommandBecomesAMotionWithoutOvershoot) {
  JointLimiter limiter = make_armed(0.0);
  double last = 0.0;
  double fastest = 0.0;
  int steps = 0;
  for (; last != 1.0 && steps < 1000; ++steps) {
    const double now = limiter.step_position({}, 1.0).value;
    ASSERT_GE(now, last);
    ASSERT_LE(now, 1.0);
    fastest = std::max(fastest, (now - last) / kPeriod);
    last = now;
  }
  EXPECT_NEAR(fastest, 1.0, 1e-9);
  EXPECT_NEAR(steps, 120, 2) << "1 m at 1 m/s and 0.2 s of ramp";
  EXPECT_EQ(limiter.step_position({}, 1.0).status, Status::kPassed);
  EXPECT_EQ(limiter.step_position({}, 1.0).value, 1.0) << "and rests there";
}

TEST(JointLimiter, CatchesUpWithACommandThatMovesAndSkippedASample) {
  JointLimiter limiter = make_armed(0.0);
  double command = 0.0;
  for (int k = 0; k < 300; ++k) {
    command += std::min(0.04 * k, 0.5) * kPeriod * (k == 100 ? 2.0 : 1.0);
    const auto limited = limiter.step_position({}, command);
    ASSERT_LE(limited.value, command + 1e-12) << "it does not overshoot";
    ASSERT_EQ(limited.status == Status::kPassed, k < 100 || k > 104) << k;
  }
  EXPECT_EQ(limiter.counts().acceleration, 5u);
}

TEST(JointLimiter, ACommandBeyondTheLimitEndsAtTheLimit) {
  JointLimiter limiter = make_armed(4.0);
  for (int k = 0; k < 300; ++k) ASSERT_LE(limiter.step_position({}, 100.0).value, 4.5);
  EXPECT_EQ(limiter.step_position({}, 100.0).value, 4.5);
  EXPECT_EQ(limiter.step_position({}, 100.0).status, Status::kClipped);
  EXPECT_EQ(limiter.counts().position, 302u);
  EXPECT_EQ(limiter.step_position({}, 4.5).status, Status::kPassed);
}

TEST(JointLimiter, ArmedOutsideItsLimitsItMayStayOrComeBackButNotGoFurther) {
  JointLimiter limiter = make_armed(5.0);
  EXPECT_EQ(limiter.step_position({}, 5.0).value, 5.0) << "arming moves nothing";
  EXPECT_EQ(limiter.step_position({}, 5.1).value, 5.0);
  EXPECT_EQ(limiter.counts().position, 1u);
  for (int k = 0; k < 100; ++k) limiter.step_position({}, 4.4);
  EXPECT_EQ(limiter.step_position({}, 4.4).value, 4.4);
  for (int k = 0; k < 100; ++k) ASSERT_LE(limiter.step_position({}, 5.0).value, 4.5);
}

TEST(JointLimiter, APositionThatIsNotFiniteBrakesToRest) {
  for (const double command : kNotFinite) {
    JointLimiter limiter = make_armed(0.0);
    double position = 0.0;
    for (int k = 0; k < 30; ++k) position = limiter.step_position({}, 3.0).value;  // 1 m/s by then
    double velocity = 1.0;
    for (int k = 0; k < 40; ++k) {
      const auto limited = limiter.step_position({}, command);
      ASSERT_EQ(limited.status, Status::kNotFinite);
      const double expected = std::max(velocity - kStep, 0.0);
      ASSERT_NEAR((limited.value - position) / kPeriod, expected, 1e-9);
      velocity = expected;
      position = limited.value;
    }
    EXPECT_EQ(limiter.counts().not_finite, 40u);
    const auto resumed = limiter.step_position({}, position);
    EXPECT_EQ(resumed.status, Status::kPassed) << "it goes on from where it came to rest";
    EXPECT_EQ(limiter.step_position({kNan, 0.0}, position).status, Status::kNotFinite);
  }
}

TEST(JointLimiter, AVelocityStopsBeforeTheLimit) {
  JointLimiter limiter = make_armed(4.0);
  double position = 4.0;
  for (int k = 0; k < 300; ++k) {
    position += limiter.step_velocity({position, 0.0}, 2.0).value * kPeriod;
    ASSERT_LE(position, 4.5 + 1e-12);
  }
  EXPECT_NEAR(position, 4.5, 1e-9);
  EXPECT_EQ(limiter.counts().velocity, 300u);
  EXPECT_GT(limiter.counts().position, 250u);
  EXPECT_EQ(limiter.step_velocity({position, 0.0}, -0.01).status, Status::kPassed);
}

TEST(JointLimiter, AVelocityThatIsNotFiniteBrakesToRest) {
  JointLimiter limiter = make_armed(0.0);
  for (int k = 0; k < 4; ++k) limiter.step_velocity({0.0, 0.0}, 1.0);
  EXPECT_DOUBLE_EQ(limiter.step_velocity({0.0, 0.0}, kNan).value, 3.0 * kStep);
  EXPECT_DOUBLE_EQ(limiter.step_velocity({kInfinity, 0.0}, 1.0).value, 2.0 * kStep);
  EXPECT_DOUBLE_EQ(limiter.step_velocity({0.0, kNan}, 1.0).value, 1.0 * kStep);
  EXPECT_EQ(limiter.step_velocity({0.0, 0.0}, -kInfinity).status, Status::kNotFinite);
  EXPECT_EQ(limiter.counts().not_finite, 4u);
  EXPECT_NEAR(limiter.step_velocity({0.0, 0.0}, kNan).value, 0.0, 1e-15);
}

TEST(JointLimiter, AnEffortIsClippedToItsLimit) {
  JointLimiter limiter = make_armed(1.0);
  EXPECT_EQ(limiter.step_effort({1.0, 0.0}, 11.0).value, 11.0);
  EXPECT_EQ(limiter.step_effort({1.0, 0.0}, 13.0).value, 12.0);
  EXPECT_EQ(limiter.step_effort({1.0, 0.0}, -13.0).value, -12.0);
  EXPECT_EQ(limiter.step_effort({1.0, 0.0}, -13.0).status, Status::kClipped);
  EXPECT_EQ(limiter.counts().effort, 3u);
}

TEST(JointLimiter, AnEffortDoesNotDriveOnWhatCannotStopInTime) {
  JointLimiter limiter = make_armed(1.0);
  // At 1 rad/s it takes 1 / (2 5) = 0.1 rad to stop.
  EXPECT_EQ(limiter.step_effort({4.39, 1.0}, 5.0).status, Status::kPassed);
  EXPECT_EQ(limiter.step_effort({4.41, 1.0}, 5.0).value, 0.0);
  EXPECT_EQ(limiter.step_effort({4.41, 1.0}, -5.0).value, -5.0) << "braking is passed";
  EXPECT_EQ(limiter.step_effort({4.41, -1.0}, 5.0).value, 5.0) << "so is what brakes the way back";
  EXPECT_EQ(limiter.step_effort({-0.41, -1.0}, -5.0).value, 0.0);
  EXPECT_EQ(limiter.step_effort({4.6, 0.0}, 5.0).value, 0.0);
  EXPECT_EQ(limiter.step_effort({4.5, 0.0}, 5.0).value, 5.0) << "holds against a weight";
  EXPECT_EQ(limiter.counts().position, 3u);
  EXPECT_EQ(limiter.step_effort({1.0, 1.01}, 5.0).value, 0.0);
  EXPECT_EQ(limiter.step_effort({1.0, -1.01}, 5.0).value, 5.0);
  EXPECT_EQ(limiter.counts().velocity, 1u);
}

TEST(JointLimiter, AnEffortByWhatIsNotFiniteIsZero) {
  JointLimiter limiter = make_armed(1.0);
  for (const double number : kNotFinite) {
    for (const auto& [measured, command] :
         {std::pair{Measured{1.0, 0.0}, number}, std::pair{Measured{number, 0.0}, 1.0},
          std::pair{Measured{1.0, number}, 1.0}}) {
      const auto limited = limiter.step_effort(measured, command);
      EXPECT_EQ(limited.value, 0.0);
      EXPECT_EQ(limited.status, Status::kNotFinite);
    }
  }
  EXPECT_EQ(limiter.counts().not_finite, 9u);
}

TEST(JointLimiter, AfterArmingTheEffortGrowsSlowlyAndNeverJumps) {
  auto config = kJoint;
  config.arming_time = 1s;
  config.effort_rate = 6.0;
  JointLimiter limiter = make_armed(1.0, config);
  double last = 0.0;
  for (int k = 1; k <= 200; ++k) {
    const auto limited = limiter.step_effort({1.0, 0.0}, 10.0);
    ASSERT_NEAR(limited.value, std::min(0.06 * k, 10.0), 1e-9) << "also when the second is over";
    ASSERT_LE(limited.value - last, 0.06 + 1e-12);
    last = limited.value;
  }
  EXPECT_EQ(limiter.counts().effort_rate, 166u);
  EXPECT_EQ(limiter.step_effort({1.0, 0.0}, -10.0).value, -10.0) << "then it is as it always is";
  ASSERT_TRUE(limiter.arm({1.0, 0.0}));
  EXPECT_NEAR(limiter.step_effort({1.0, 0.0}, -10.0).value, -0.06, 1e-12) << "armed again";
}

TEST(JointLimiter, AfterArmingEffortIsTakenAwayAtOnce) {
  auto config = kJoint;
  config.arming_time = 1s;
  config.effort_rate = 6.0;
  JointLimiter limiter = make_armed(1.0, config);
  for (int k = 0; k < 50; ++k) limiter.step_effort({1.0, 0.0}, 10.0);
  EXPECT_EQ(limiter.step_effort({1.0, 0.0}, 0.0).value, 0.0);
}

TEST(JointLimiter, PassesNothingBeforeItIsArmed) {
  JointLimiter limiter = JointLimiter::make(kJoint).value();
  EXPECT_FALSE(limiter.arm({kNan, 0.0}));
  EXPECT_FALSE(limiter.arm({0.0, kInfinity}));
  EXPECT_EQ(limiter.step_effort({0.0, 0.0}, 5.0).value, 0.0);
  EXPECT_EQ(limiter.step_velocity({0.0, 0.0}, 0.5).value, 0.0);
  EXPECT_EQ(limiter.step_position({0.3, 0.0}, 0.5).value, 0.3) << "the reference is the measured";
  EXPECT_EQ(limiter.step_position({kNan, 0.0}, 0.5).value, 0.3);
  EXPECT_EQ(limiter.step_position({0.3, 0.0}, 0.5).status, Status::kDisarmed);
}

TEST(JointLimiter, ArmingAgainBeginsWhereTheJointIs) {
  JointLimiter limiter = make_armed(0.0);
  for (int k = 0; k < 30; ++k) limiter.step_position({}, 3.0);
  limiter.disarm();
  EXPECT_FALSE(limiter.armed());
  EXPECT_EQ(limiter.step_position({1.7, 0.0}, 3.0).value, 1.7);
  ASSERT_TRUE(limiter.arm({1.7, 0.3}));
  EXPECT_NEAR(limiter.step_position({}, 3.0).value, 1.7 + kStep * kPeriod, 1e-12) << "from rest";
}

TEST(JointLimiter, ARefusedConfigurationNamesEveryFieldThatIsWrong) {
  const auto text =
      JointLimiter::make({.lower = 1.0, .upper = kNan, .max_velocity = -1.0, .arming_time = 1s})
          .error();
  EXPECT_THAT(text, HasSubstr("JointLimiter: upper is nan, expected a number"));
  EXPECT_THAT(text, HasSubstr("max_velocity is -1, expected a finite number above 0"));
  EXPECT_THAT(text, HasSubstr("max_acceleration is 0"));
  EXPECT_THAT(text, HasSubstr("max_effort is 0"));
  EXPECT_THAT(text, HasSubstr("period [s] is 0"));
  EXPECT_THAT(text, HasSubstr("effort_rate is 0"));
}

/// Commands of all kinds: steps, walks, far out, huge, not finite.
class RandomCommands {
 public:
  explicit RandomCommands(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double next() {
    switch (random_() % 40) {
      case 0:
        return last_ = between(-5.0, 5.0);
      case 1:
        return std::copysign(std::pow(10.0, between(-3.0, 308.0)), between(-1.0, 1.0));
      case 2:
        return kNotFinite[random_() % kNotFinite.size()];
      case 3:
        drift_ = between(-0.05, 0.05);
        return last_;
      default:
        return last_ = std::clamp(last_ + drift_ + between(-0.001, 0.001), -6.0, 6.0);
    }
  }
  JointLimiter::Config config() {
    return {.lower = between(-3.0, -0.1),
            .upper = between(0.1, 3.0),
            .max_velocity = std::pow(10.0, between(-1.0, 1.0)),
            .max_acceleration = std::pow(10.0, between(-1.0, 2.0)),
            .max_effort = between(1.0, 20.0),
            .period = random_() % 2 == 0 ? 1ms : 10ms};
  }

 private:
  std::mt19937_64 random_;
  double last_ = 0.0;
  double drift_ = 0.0;
};

TEST(JointLimiter, NoPositionLeavesALimitOrCannotStopBeforeIt) {
  RandomCommands random(4711);
  for (int round = 0; round < 100; ++round) {
    const auto config = random.config();
    JointLimiter limiter = make_armed(0.0, config);
    const double step = config.max_acceleration * base::to_seconds(config.period);
    double position = 0.0;
    double velocity = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const double now = limiter.step_position({}, random.next()).value;
      const double velocity_now = (now - position) / base::to_seconds(config.period);
      ASSERT_GE(now, config.lower);
      ASSERT_LE(now, config.upper);
      ASSERT_LE(std::abs(velocity_now), config.max_velocity + 1e-5 * step);
      ASSERT_LE(std::abs(velocity_now - velocity), step * (1.0 + 1e-5) + 1e-9);
      ASSERT_TRUE(can_stop(config, now, velocity_now)) << now << " with " << velocity_now;
      position = now;
      velocity = velocity_now;
    }
  }
}

TEST(JointLimiter, NoVelocityLeavesALimitOrCannotStopBeforeIt) {
  RandomCommands random(815);
  for (int round = 0; round < 100; ++round) {
    const auto config = random.config();
    JointLimiter limiter = make_armed(0.0, config);
    const double step = config.max_acceleration * base::to_seconds(config.period);
    double position = 0.0;
    double velocity = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const double now = limiter.step_velocity({position, velocity}, random.next()).value;
      ASSERT_LE(std::abs(now), config.max_velocity + 1e-9);
      ASSERT_LE(std::abs(now - velocity), step * (1.0 + 1e-9));
      position += now * base::to_seconds(config.period);
      velocity = now;
      ASSERT_GE(position, config.lower - 1e-9);
      ASSERT_LE(position, config.upper + 1e-9);
      ASSERT_TRUE(can_stop(config, position, velocity)) << position << " with " << velocity;
    }
  }
}

TEST(JointLimiter, NoEffortIsTooLargeOrDrivesOnWhatCannotStop) {
  RandomCommands random(1234);
  const auto config = random.config();
  JointLimiter limiter = make_armed(0.0, config);
  for (int k = 0; k < 200'000; ++k) {
    const Measured measured{random.next(), random.next()};
    const double effort = limiter.step_effort(measured, 10.0 * random.next()).value;
    ASSERT_LE(std::abs(effort), config.max_effort);
    const double way =
        measured.velocity * std::abs(measured.velocity) / (2.0 * config.max_acceleration);
    const bool drives_up = effort > 0.0 && measured.velocity >= 0.0;
    const bool drives_down = effort < 0.0 && measured.velocity <= 0.0;
    ASSERT_TRUE(!drives_up || measured.position + way <= config.upper + 1e-12);
    ASSERT_TRUE(!drives_down || measured.position + way >= config.lower - 1e-12);
    ASSERT_TRUE(!(drives_up || drives_down) || std::abs(measured.velocity) <= config.max_velocity);
  }
}

}  // namespace
}  // namespace armature::control
