// SPDX-License-Identifier: Apache-2.0
#include "armature/control/sampled_loop.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/low_pass.hpp"

namespace armature::control {
namespace {

using ::testing::HasSubstr;

constexpr double kPeriod = 0.002;

/// One step of a controller: from the error to the effort.
using Step = std::function<double(double)>;

Step step_of(const Pid::Config& gains) {
  return [pid = Pid::make(gains).value()](double error) mutable { return pid.step(error); };
}

Step step_of(const PositionalPid::Config& gains) {
  return
      [pid = PositionalPid::make(gains).value()](double error) mutable { return pid.step(error); };
}

/// As ControllerOfModel has it.
Step step_of(const SampledController::FilteredPd& gains) {
  auto filter = LowPass::make({.omega = gains.cutoff, .period_s = gains.period_s}).value();
  return [=, last = 0.0](double error) mutable {
    const double rate = (error - last) / gains.period_s;
    last = error;
    return gains.kp * error + gains.kd * filter.step(rate);
  };
}

/// Whether a joint that is let go beside its reference swings more and more, by small steps of time
/// that share nothing with the formulas under test.
bool grows(const JointPlant& plant, const Step& step, double period_s) {
  constexpr int kInner = 100;
  constexpr int kCycles = 3000;
  const double dt = period_s / kInner;
  const int late = static_cast<int>(std::lround(plant.delay_s / dt));
  double angle = 1e-3, rate = 0.0, effort = 0.0, next = 0.0, early = 0.0, end = 0.0;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    const double before = next;
    next = step(-angle);
    for (int inner = 0; inner < kInner; ++inner) {
      effort = inner >= late ? next : before;
      const auto acceleration = [&](double at) {
        return (plant.torque_per_effort * effort - plant.damping * at) / plant.inertia;
      };
      const double halfway = rate + acceleration(rate) * dt / 2.0;
      angle += halfway * dt;
      rate += acceleration(halfway) * dt;
    }
    if (!std::isfinite(angle) || std::abs(angle) > 1e6) return true;
    double& largest = cycle < kCycles / 2 ? early : end;
    if (cycle > kCycles / 4) largest = std::max(largest, std::abs(rate));
  }
  return end > early;
}

Pid::Config times(Pid::Config gains, double share) {
  return {gains.kp * share, gains.ki * share, gains.kd * share, gains.u_min, gains.u_max};
}
PositionalPid::Config times(PositionalPid::Config gains, double share) {
  gains.kp *= share;
  gains.ki *= share;
  gains.kd *= share;
  return gains;
}
SampledController::FilteredPd times(SampledController::FilteredPd gains, double share) {
  return {gains.kp * share, gains.kd * share, gains.cutoff, gains.period_s};
}

/// The gain margin is where a simulated joint begins to shake.
template <typename Gains>
void expect_margin_as_simulated(const JointPlant& plant, const Gains& gains, double period_s,
                                const std::string& what) {
  const LoopStability loop = judge_loop(plant, SampledController::of(gains), period_s);
  ASSERT_GT(loop.gain_margin, 0.0) << what;
  if (loop.gain_margin > 100.0) return;
  const double below = loop.gain_margin * 0.98;
  EXPECT_EQ(has_margin(plant, SampledController::of(gains), period_s), loop.has_margin()) << what;
  EXPECT_TRUE(grows(plant, step_of(times(gains, loop.gain_margin * 1.02)), period_s)) << what;
  if (below > 1.05 * loop.least_gain) {
    EXPECT_FALSE(grows(plant, step_of(times(gains, below)), period_s)) << what;
  }
}

/// A rate by the difference of two samples acts as the mean of the rates at both: with h = kd T / J
/// the poles are those of z^2 + (h/2 - 1) z + h/2, so that the limit is h = 2, at z = +-i.
TEST(SampledLoop, ADamperIsStableUpToTwiceItsInertiaInAPeriod) {
  const JointPlant plant{.inertia = 0.3};
  const double limit = 2.0 * 0.3 / kPeriod;
  const PositionalPid::Config gains{.kd = limit / 5.0, .period_s = kPeriod};
  const LoopStability loop = judge_loop(plant, SampledController::of(gains), kPeriod);
  EXPECT_NEAR(loop.gain_margin, 5.0, 1e-6);
  EXPECT_NEAR(loop.frequency, M_PI / 2.0 / kPeriod, 1.0);
  EXPECT_TRUE(loop.has_margin());
}

/// A period later it is z^3 - z^2 + h/2 (z + 1), whose border is at h^2/4 + h/2 - ... = 0: on the
/// unit circle the products of its coefficients give h/2 (1 + h/2) = 1 - h/2.
TEST(SampledLoop, ADelayOfAPeriodTakesMostOfTheMarginAway) {
  const JointPlant plant{.inertia = 0.3, .delay_s = kPeriod};
  const double h = 2.0 * (std::sqrt(2.0) - 1.0);
  const PositionalPid::Config gains{.kd = h * 0.3 / kPeriod / 3.0, .period_s = kPeriod};
  EXPECT_NEAR(judge_loop(plant, SampledController::of(gains), kPeriod).gain_margin, 3.0, 1e-6);
}

TEST(SampledLoop, ASpringWithoutADamperIsRefusedHoweverSoft) {
  const PositionalPid::Config gains{.kp = 1.0, .period_s = kPeriod};
  const LoopStability loop =
      judge_loop({.inertia = 0.3, .delay_s = 0.001}, SampledController::of(gains), kPeriod);
  EXPECT_FALSE(loop.has_margin());
  EXPECT_GT(loop.largest_pole, 1.0);
  EXPECT_THAT(objection_to_loop(loop), HasSubstr(", expected below 1"));
}

TEST(SampledLoop, AnIntegralThatIsTooLargeIsUnstableBelowSomeGain) {
  // Slow sampling counts little: J s^3 + kd s^2 + kp s + ki is stable for kp kd > J ki.
  const PositionalPid::Config gains{
      .kp = 10.0, .ki = 10.0 * 2.0 / 0.5 / 4.0, .kd = 2.0, .period_s = 1e-4};
  const LoopStability loop =
      judge_loop({.inertia = 0.5}, SampledController::of(gains), gains.period_s);
  EXPECT_NEAR(loop.least_gain, 0.25, 0.01);
  EXPECT_TRUE(loop.has_margin());
  PositionalPid::Config larger = gains;
  larger.ki *= 3.0;
  const LoopStability tight =
      judge_loop({.inertia = 0.5}, SampledController::of(larger), gains.period_s);
  EXPECT_FALSE(tight.has_margin());
  EXPECT_THAT(objection_to_loop(tight), HasSubstr("give a smaller integral gain"));
}

TEST(SampledLoop, WhereNoPartOfTheGainsHelpsOtherGainsAreAsked) {
  const PositionalPid::Config gains{.kp = 1.0, .ki = 200.0, .kd = 1e-3, .period_s = 1e-4};
  const LoopStability loop =
      judge_loop({.inertia = 0.5}, SampledController::of(gains), gains.period_s);
  EXPECT_THAT(objection_to_loop(loop),
              HasSubstr("give a smaller proportional or integral, or a larger differential gain"));
}

TEST(SampledLoop, OfThePositionalPidShakesWhereASimulatedOneDoes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decades(-1.0, 1.0), share(0.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const JointPlant plant{.inertia = 0.1 * std::pow(10.0, decades(random)),
                           .damping = share(random),
                           .delay_s = 1e-4 * std::floor(15.0 * share(random))};
    const double omega = 60.0 * std::pow(10.0, 0.5 * decades(random));
    const double kp = plant.inertia * omega * omega;
    const PositionalPid::Config gains{
        .kp = kp, .ki = kp * share(random), .kd = 1.5 * kp / omega, .period_s = kPeriod};
    expect_margin_as_simulated(plant, gains, kPeriod, "set " + std::to_string(i));
  }
}

TEST(SampledLoop, OfThePidInVelocityFormShakesWhereASimulatedOneDoes) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> decades(-1.0, 1.0), share(0.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const JointPlant plant{.inertia = 0.1 * std::pow(10.0, decades(random)),
                           .damping = 5.0 * share(random),
                           .torque_per_effort = 0.5 + 2.0 * share(random),
                           .delay_s = 1e-3 * std::floor(10.0 * share(random))};
    const double omega = 10.0 * std::pow(10.0, 0.5 * decades(random));
    const double kp = plant.inertia * omega * omega / plant.torque_per_effort;
    const Pid::Config gains{.kp = kp,
                            .ki = 0.01 * kp * share(random),
                            .kd = 1.5 * kp / omega / 0.01,
                            .u_min = -1e12,
                            .u_max = 1e12};
    expect_margin_as_simulated(plant, gains, 0.01, "set " + std::to_string(i));
  }
}

TEST(SampledLoop, OfAFilteredPdShakesWhereASimulatedOneDoes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> decades(-1.0, 1.0), share(0.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const JointPlant plant{.inertia = 0.1 * std::pow(10.0, decades(random)),
                           .damping = share(random),
                           .delay_s = 1e-4 * std::floor(15.0 * share(random))};
    const double omega = 40.0 * std::pow(10.0, 0.5 * decades(random));
    const double kp = plant.inertia * omega * omega;
    const SampledController::FilteredPd gains{.kp = kp,
                                              .kd = 2.0 * kp / omega,
                                              .cutoff = 180.0 + 820.0 * share(random),
                                              .period_s = kPeriod};
    expect_margin_as_simulated(plant, gains, kPeriod, "set " + std::to_string(i));
  }
}

TEST(SampledLoop, SaysHowMuchOfTheGainsMayBe) {
  const JointPlant plant{.inertia = 0.3};
  const double limit = 2.0 * 0.3 / kPeriod;
  const auto objection = [&](double kd) {
    const PositionalPid::Config gains{.kd = kd, .period_s = kPeriod};
    return objection_to_loop(judge_loop(plant, SampledController::of(gains), kPeriod));
  };
  EXPECT_EQ(objection(limit / 2.01), "");
  EXPECT_EQ(objection(limit / 1.6),
            "gain margin 1.6 at 785 rad/s, expected at least 2: give at most 0.8 of these gains");
  EXPECT_EQ(objection(limit * 4.0),
            "shakes at 785 rad/s (largest pole 2, expected below 1): give at most 0.125 of these "
            "gains");
}

TEST(SampledLoop, WhatIsNoNumberHasNoMargin) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const PositionalPid::Config good{.kp = 1.0, .kd = 1.0, .period_s = kPeriod};
  for (const double wrong : {kNan, kInfinity}) {
    PositionalPid::Config gains = good;
    gains.kp = wrong;
    const LoopStability loop = judge_loop({.inertia = 0.3}, SampledController::of(gains), kPeriod);
    EXPECT_FALSE(loop.has_margin());
    EXPECT_EQ(objection_to_loop(loop), "the gains or the robot's numbers are not finite");
    EXPECT_FALSE(judge_loop({.inertia = wrong}, SampledController::of(good), kPeriod).has_margin());
  }
  EXPECT_FALSE(judge_loop({.inertia = 0.0}, SampledController::of(good), kPeriod).has_margin());
}

}  // namespace
}  // namespace armature::control
