// SPDX-License-Identifier: Apache-2.0
// The real-time functions of control by which a robot is armed, held, and handed over.
#include <chrono>
#include <vector>

#include "armature/control/arming/arming_sequence.hpp"
#include "armature/control/arming/gain_fade.hpp"
#include "armature/control/arming/holding_watch.hpp"
#include "armature/control/arming/resting_mean.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::control {
namespace {

using namespace std::chrono_literals;

TEST(RealtimeFunctions, ArmingSequenceToItsEnd) {
  auto sequence = ArmingSequence::make({.max_motion = 0.01,
                                        .effort_tolerance = 0.2,
                                        .settling_time = 100ms,
                                        .patience = 2s,
                                        .watch_time = 200ms})
                      .value();
  base::Time now{};
  expect_realtime("ArmingSequence::begin", [&] { sequence.begin(1.0, now); });
  bool done = false;
  expect_realtime("ArmingSequence::step", [&] {
    const ArmingSequence::Measured held{.position = 1.0, .effort = 4.0};
    if (!done) done = sequence.step(held, now += 10ms) == ArmingSequence::Next::kDone;
  });
  EXPECT_TRUE(sequence.let_go());
  EXPECT_TRUE(done);
}

TEST(RealtimeFunctions, ArmingSequenceThatFails) {
  auto sequence = ArmingSequence::make({.max_motion = 0.01,
                                        .effort_tolerance = 0.2,
                                        .settling_time = 100ms,
                                        .patience = 500ms,
                                        .watch_time = 200ms})
                      .value();
  base::Time now{};
  ArmingSequence::Next moved{};
  ArmingSequence::Next patient{};
  expect_realtime("ArmingSequence::step", [&] {
    sequence.begin(1.0, now);
    moved = sequence.step({.position = 1.1, .effort = 4.0}, now += 10ms);
    sequence.begin(1.0, now);
    patient = sequence.step({.position = 1.0, .effort = 4.0}, now += 600ms);
  });
  EXPECT_EQ(moved, ArmingSequence::Next::kMovedBefore);
  EXPECT_EQ(patient, ArmingSequence::Next::kNeverSettled);
}

TEST(RealtimeFunctions, HoldingWatchOfAJointThatShakesAndOneThatFalls) {
  auto watch = HoldingWatch::make({.period = 10ms,
                                   .max_motion = 0.1,
                                   .max_velocity = 0.5,
                                   .least_effort = 0.5,
                                   .max_alternation = 0.5,
                                   .alternation_time = 200ms,
                                   .rest_velocity = 0.02,
                                   .settling_time = 1s})
                   .value();
  expect_realtime("HoldingWatch::stand", [&] { watch.stand(); });
  EXPECT_TRUE(watch.is_to_stand());
  HoldingWatch::Measured measured{.effort = 1.0, .driven = true};
  HoldingWatch::Finding finding;
  expect_realtime("HoldingWatch::step", [&] {
    measured.effort = -measured.effort;
    finding = watch.step(measured);
  });
  EXPECT_EQ(finding.verdict, HoldingWatch::Verdict::kAlternates);
  expect_realtime("HoldingWatch::step", [&] {
    measured.position += 0.01;
    finding = watch.step(measured);
  });
  EXPECT_EQ(finding.verdict, HoldingWatch::Verdict::kMoved);
  expect_realtime("HoldingWatch::move", [&] { watch.move(); });
  EXPECT_FALSE(watch.is_to_stand());
  expect_realtime("HoldingWatch::judge_effort", [&] {
    finding = {};
    for (int i = 0; i < 100 && !finding.is_alarm(); ++i) {
      finding = watch.judge_effort(i % 2 == 0 ? 1.0 : -1.0);
    }
  });
  EXPECT_EQ(finding.verdict, HoldingWatch::Verdict::kAlternates);
}

TEST(RealtimeFunctions, GainFadeToAndFro) {
  const Pid::Config soft{.kp = 1.0, .ki = 0.1, .kd = 0.1};
  const Pid::Config stiff{.kp = 2.0, .ki = 0.1, .kd = 0.2};
  GainFade fade;
  base::Time now{};
  expect_realtime("GainFade::be", [&] { fade.be(soft); });
  int steps = 0;
  double kp = 0.0;
  expect_realtime("GainFade::step", [&] {
    const Pid::Config& wanted = steps++ < 60 ? stiff : soft;
    kp = fade.step(wanted, now += 10ms, 500ms).kp;
  });
  EXPECT_LT(kp, 2.0);
  EXPECT_GT(kp, 1.0) << "it is on its way back";
}

TEST(RealtimeFunctions, RestingMeanOfManySignals) {
  RestingMean mean(7, 10);
  const std::vector<double> signals(7, 3.0);
  expect_realtime("RestingMean::add", [&] { mean.add(signals, true); });
  ASSERT_EQ(mean.get().size(), 7u);
  EXPECT_NEAR(mean.get()[6], 3.0, 1e-12);
  expect_realtime("RestingMean::add, in motion", [&] { mean.add(signals, false); });
  EXPECT_TRUE(mean.get().empty());
  mean.add(signals, true);
  expect_realtime("RestingMean::reset", [&] { mean.reset(); });
  EXPECT_TRUE(mean.get().empty());
}

}  // namespace
}  // namespace armature::control
