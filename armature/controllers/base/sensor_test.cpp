// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/sensor.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

/// Leaves `sample_now` as it is, and tells what it noted.
class NotingSensor final : public Sensor {
 public:
  using Sensor::Sensor;
  using Sensor::take_sample;
};

class SensorTest : public ::testing::Test {
 protected:
  SensorTest() : sensor(std::make_unique<NotingSensor>("Sensor")) { sensor.set("joints", 1); }
  NotingSensor& noting() { return dynamic_cast<NotingSensor&>(sensor.component()); }

  testing::Harness sensor;
};

TEST_F(SensorTest, NotesASampleOnceByDefault) {
  ASSERT_TRUE(sensor.start()) << sensor.reason();
  EXPECT_FALSE(noting().take_sample());
  sensor.raise("Sample");
  EXPECT_TRUE(noting().take_sample());
  EXPECT_FALSE(noting().take_sample()) << "it was taken";
  EXPECT_EQ(sensor.writes("sensor"), 0u) << "nothing reads the robot's sensors";
}

TEST_F(SensorTest, ForgetsASampleFromBeforeItsStart) {
  ASSERT_TRUE(sensor.start()) << sensor.reason();
  sensor.raise("Sample");
  sensor.stop();
  ASSERT_TRUE(sensor.start()) << sensor.reason();
  EXPECT_FALSE(noting().take_sample());
}

}  // namespace
}  // namespace armature::controllers
