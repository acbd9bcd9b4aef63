// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/sensor_mux/sensor_mux.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// With joints that answer q = value and d = value / 10.
class SensorMux : public ::testing::Test {
 protected:
  void start(int joints = 2) {
    sensor.set("joints", joints);
    ASSERT_TRUE(sensor.start()) << sensor.reason();
  }
  void sample() { sensor.raise("Sample"); }
  void answer(int joint, double value) {
    sensor.write("Position" + std::to_string(joint), value);
    sensor.write("Displacement" + std::to_string(joint), value / 10.0);
  }
  void complete_round(double first, double second) {
    sample();
    answer(1, first);
    answer(2, second);
  }
  const std::vector<double>& measured() { return sensor.output<std::vector<double>>("sensor"); }
  std::uint64_t writes() { return sensor.writes("sensor"); }

  testing::Harness sensor{std::make_unique<SensorNMux>("Sensor")};
};

TEST_F(SensorMux, WritesOnceAllValuesArrivedAfterASample) {
  start();
  sample();
  answer(2, 2.0);
  sensor.write("Displacement1", 0.1);
  EXPECT_EQ(writes(), 0u);
  sensor.write("Position1", 1.0);
  EXPECT_EQ(writes(), 1u);
  EXPECT_THAT(measured(), ElementsAre(1.0, 2.0, 0.1, 0.2));
}

TEST_F(SensorMux, WritesNothingWithoutASample) {
  start();
  answer(1, 1.0);
  answer(2, 2.0);
  EXPECT_EQ(writes(), 0u);
  complete_round(3.0, 4.0);
  answer(1, 5.0);
  answer(2, 6.0);
  EXPECT_EQ(writes(), 1u);
}

TEST_F(SensorMux, HoldsTheLastValuesOfAMissingJointAndNamesIt) {
  start();
  complete_round(1.0, 2.0);
  sample();
  answer(1, 3.0);
  EXPECT_EQ(writes(), 1u);  // joint 2 is waited for
  sample();
  EXPECT_EQ(sensor.get<int>("incomplete_rounds"), 1);
  EXPECT_THAT(sensor.get<std::vector<int>>("missing"), ElementsAre(0, 1));
  EXPECT_EQ(sensor.get<component::Reason>("missing_names").view(), "Position2");
  EXPECT_THAT(sensor.log(), ElementsAre(HasSubstr("no answer from Position2")));
  answer(1, 4.0);
  EXPECT_EQ(writes(), 2u);  // in time
  EXPECT_THAT(measured(), ElementsAre(4.0, 2.0, 0.4, 0.2));
}

TEST_F(SensorMux, DoesNotTakeALateAnswerForThatOfTheNextRound) {
  start();
  complete_round(1.0, 2.0);
  sample();
  answer(1, 3.0);
  sample();
  answer(2, 2.5);  // of the round before
  EXPECT_EQ(writes(), 1u);
  answer(1, 4.0);
  EXPECT_THAT(measured(), ElementsAre(4.0, 2.0, 0.4, 0.2));
  complete_round(5.0, 6.0);
  EXPECT_THAT(measured(), ElementsAre(5.0, 6.0, 0.5, 0.6));
  EXPECT_EQ(sensor.get<int>("incomplete_rounds"), 1);
}

TEST_F(SensorMux, CountsNoZeroAsMeasuredBeforeAJointAnswered) {
  start();
  sample();
  answer(1, 1.0);
  sample();
  answer(1, 2.0);
  EXPECT_EQ(writes(), 0u);
  EXPECT_THAT(sensor.get<std::vector<int>>("missing"), ElementsAre(0, 1));
  answer(2, 3.0);
  EXPECT_THAT(measured(), ElementsAre(2.0, 3.0, 0.2, 0.3));
}

TEST_F(SensorMux, GivesAJointUpAfterTooManyRoundsInARow) {
  start();
  const auto& missing = sensor.record<int, ComponentName>("Missing");
  complete_round(1.0, 2.0);
  sample();
  for (int round = 0; round < 2; ++round) {
    answer(1, 3.0);
    sample();
    ASSERT_EQ(sensor.state(), component::State::kRunning);
  }
  answer(1, 3.0);
  sample();
  EXPECT_EQ(sensor.state(), component::State::kException);
  EXPECT_EQ(sensor.reason(), "Position2 (number 2) did not answer in 3 rounds in a row");
  EXPECT_THAT(missing, ElementsAre(std::make_tuple(2, ComponentName("Position2"))));
  EXPECT_EQ(writes(), 3u);
}

TEST_F(SensorMux, HowManyRoundsIsAProperty) {
  sensor.set("max_missing", 1);
  start();
  sample();
  answer(1, 1.0);
  sample();
  EXPECT_EQ(sensor.state(), component::State::kException);
  EXPECT_EQ(sensor.reason(), "Position2 (number 2) did not answer in 1 round");
}

TEST_F(SensorMux, APropertyThatChangedWhileItWasStoppedCounts) {
  start();
  sensor.stop();
  sensor.set("max_missing", 1);
  ASSERT_TRUE(sensor.start()) << sensor.reason();
  sample();
  sample();
  EXPECT_EQ(sensor.state(), component::State::kException);
}

TEST_F(SensorMux, GoesOnAtTheSampleIfAllJointsAreMissing) {
  start();
  complete_round(1.0, 2.0);
  sample();
  sample();
  EXPECT_EQ(writes(), 2u);
  EXPECT_THAT(measured(), ElementsAre(1.0, 2.0, 0.1, 0.2));
  EXPECT_EQ(sensor.get<component::Reason>("missing_names").view(), "Position1, Position2");
  answer(1, 3.0);
  answer(2, 4.0);
  complete_round(5.0, 6.0);
  EXPECT_EQ(writes(), 3u);
  EXPECT_EQ(sensor.state(), component::State::kRunning);
}

TEST_F(SensorMux, FaultsForAValueThatIsNoNumberAndSaysWhose) {
  start();
  sample();
  answer(1, 1.0);
  sensor.write("Displacement2", std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(sensor.state(), component::State::kException);
  EXPECT_EQ(sensor.reason(),
            "Displacement2 measured Displacement2 = nan, expected a finite number");
  EXPECT_EQ(writes(), 0u);
}

TEST_F(SensorMux, ForgetsAllAtAStart) {
  start();
  complete_round(1.0, 2.0);
  sample();
  sample();
  sensor.stop();
  ASSERT_TRUE(sensor.start()) << sensor.reason();
  EXPECT_THAT(sensor.get<std::vector<int>>("missing"), ElementsAre(0, 0));
  EXPECT_EQ(sensor.get<component::Reason>("missing_names").view(), "");
  sample();
  answer(1, 3.0);
  sample();
  answer(1, 4.0);
  EXPECT_EQ(writes(), 2u);  // what joint 2 measured before the start is not held
}

TEST_F(SensorMux, IsForAnyNumberOfJoints) {
  start(1000);
  sample();
  for (int joint = 1; joint < 1000; ++joint) answer(joint, joint);
  EXPECT_EQ(writes(), 0u);
  answer(1000, 1000.0);
  ASSERT_EQ(writes(), 1u);
  EXPECT_EQ(measured()[0], 1.0);
  EXPECT_EQ(measured()[999], 1000.0);
  EXPECT_EQ(measured()[1999], 100.0);
}

}  // namespace
}  // namespace armature::controllers
