// SPDX-License-Identifier: Apache-2.0
// Joints whose drives are given torques, or follow velocities or positions; absolute sensors.
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/internal/test_joint.hpp"

namespace armature::controllers {
namespace {

using component::State;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// With a gear of 100.
template <JointCommand kWay>
class JointOfWay : public JointTest {
 protected:
  explicit JointOfWay(double limit)
      : JointTest(std::make_unique<JointOf<kWay>>("Joint1"), kWay, limit) {
    joint.set("MaxVelocity", 2.0);
  }
  /// What the hardware gets of `command`.
  template <typename Limited>
  double told(double command) {
    joint.write(names_of(kWay).command, command);
    joint.raise("Act");
    return joint.output<Limited>(names_of(kWay).actuator);
  }
  /// Until it is armed, with a command that holds it.
  template <typename Limited>
  void arm_with(double command, double of_motor) {
    joint.raise("Arm");
    for (int k = 0; k < 400 && !armed(); ++k) {
      told<Limited>(command);
      measure(of_motor);
    }
    ASSERT_TRUE(armed());
    calls.clear();
  }
  /// A sampling period, after which the motor's axis is there.
  void measure(double of_motor) {
    joint.advance(std::chrono::milliseconds(10));
    joint.raise("Sample");
    joint.write("PositionSensor", of_motor);
  }
};

// --- torques -----------------------------------------------------------------------------------

class TorqueJoint : public JointOfWay<JointCommand::kTorque> {
 protected:
  TorqueJoint() : JointOfWay(20.0) {}
};

TEST_F(TorqueJoint, TheMotorGetsTheTorqueOfTheJointThroughItsGear) {
  joint.set("ActuatorSign", -1.0);
  start();
  joint.raise("Arm");
  for (int k = 0; k < 400 && !armed(); ++k) {
    told<control::LimitedEffort>(5.0);
    sample();
  }
  ASSERT_TRUE(armed());
  EXPECT_DOUBLE_EQ(told<control::LimitedEffort>(5.0), -0.05);
  EXPECT_DOUBLE_EQ(told<control::LimitedEffort>(50.0), -0.2) << "MaxTorque at the joint";
  EXPECT_EQ(joint.get<int>("clipped"), 1);
  EXPECT_EQ(told<control::LimitedEffort>(kNan), 0.0);
  EXPECT_THAT(joint.reason(), HasSubstr("Torque is nan"));
}

// --- linear axes -------------------------------------------------------------------------------

/// In m; what would be noise of a joint that turns is motion of an axis.
TEST_F(TorqueJoint, ALinearAxisRestsOnlyBelowOneMillimetreInASecond) {
  joint.set("Unit", std::string("m"));
  start();
  joint.raise("Arm");
  for (int k = 0; k < 400 && !armed(); ++k) {
    told<control::LimitedEffort>(0.0);
    sample();
  }
  ASSERT_TRUE(armed());
  sample(0.01);  // 10 mm/s
  calls.clear();
  joint.raise("Disarm");
  EXPECT_THAT(commands(), ElementsAre("brakeApply")) << "its motor brakes it";
  sample(0.0005);
  EXPECT_THAT(commands(), ElementsAre("brakeApply", "actuatorOff"));
}

// --- positions ---------------------------------------------------------------------------------

class PositionJoint : public JointOfWay<JointCommand::kPosition> {
 protected:
  PositionJoint() : JointOfWay(0.05) {
    joint.set("InitialPos", 0.5);  // where the sensor says 0
    joint.set("SensorSign", -1.0);
    joint.write("PositionSensor", 0.0);  // connects it
  }
  double told(double command) { return JointOfWay::told<control::LimitedPosition>(command); }
  /// At 1 rad.
  void start_at_one() {
    ASSERT_TRUE(joint.start()) << joint.reason();
    measure(-50.0);
    calls.clear();
  }
  void start_armed() {
    start_at_one();
    arm_with<control::LimitedPosition>(1.0, -50.0);
  }
};

TEST_F(PositionJoint, IsWhereItsSensorSaysFromTheFirstSampleOn) {
  start_at_one();
  EXPECT_DOUBLE_EQ(position(), 1.0);
  EXPECT_DOUBLE_EQ(joint.output<double>("Displacement"), 0.0);
  measure(-51.0);
  EXPECT_DOUBLE_EQ(position(), 1.01);
  EXPECT_NEAR(joint.output<double>("Displacement"), 0.01, 1e-12);
}

TEST_F(PositionJoint, ThatWasTurnedWhileItWasStoppedIsWhereItIs) {
  start_at_one();
  joint.stop();
  ASSERT_TRUE(joint.start());
  measure(-150.0);
  EXPECT_DOUBLE_EQ(position(), 2.0);
  EXPECT_EQ(joint.state(), State::kRunning) << "no jump";
}

TEST_F(PositionJoint, IsArmedWhereItIsAndMovesNoFasterThanItMay) {
  start_armed();
  EXPECT_DOUBLE_EQ(told(1.0), -50.0);
  double before = -50.0;
  for (int k = 0; k < 200; ++k) {
    const double now = told(1.8);
    EXPECT_LE(std::abs(now - before), 2.0 * 0.01 * 100.0 + 1e-9);
    before = now;
    measure(now);
  }
  EXPECT_DOUBLE_EQ(before, -130.0) << "there";
  EXPECT_TRUE(armed());
}

TEST_F(PositionJoint, IsNotSentBeyondItsEnd) {
  start_armed();
  double now = 0.0;
  for (int k = 0; k < 600; ++k) {
    now = told(9.0);
    measure(now);
  }
  EXPECT_NEAR(now, -(4.5 - 0.5) * 100.0, 1e-6);
}

TEST_F(PositionJoint, WhileItIsDisarmedItsDriveIsToldWhereItIs) {
  start_at_one();
  EXPECT_DOUBLE_EQ(told(3.0), -50.0);
  measure(-52.0);
  EXPECT_DOUBLE_EQ(told(3.0), -52.0);
}

TEST_F(PositionJoint, WhoseDriveDoesNotFollowIsBrakedAndFaults) {
  start_armed();
  for (int k = 0; k < 100 && armed(); ++k) {
    told(2.0);
    measure(-50.0 - 1e-6 * k);
  }
  EXPECT_FALSE(armed());
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_THAT(joint.reason(), HasSubstr("its drive has it at 1 rad and was told 1.05"));
  EXPECT_THAT(joint.reason(), HasSubstr("MaxPositionError: 0.05"));
  EXPECT_THAT(commands(), ElementsAre("brakeApply", "actuatorOff"));
}

TEST_F(PositionJoint, WhosePositionStaysTheSameWhileItIsToldToMoveFaultsBefore) {
  start_armed();
  double told_last = 0.0;
  for (int k = 0; k < 1000 && armed(); ++k) {
    told_last = told(1.0 + 0.0005 * k);
    measure(-50.0);
  }
  EXPECT_FALSE(armed());
  EXPECT_THAT(joint.reason(), HasSubstr("its position has stayed 1 rad to the bit"));
  EXPECT_NEAR(told_last, -50.0 - 100.0 * 0.05 / 3.0, 0.1) << "a third of MaxPositionError";
  EXPECT_THAT(commands(), ElementsAre("brakeApply", "actuatorOff"));
}

TEST_F(PositionJoint, AJumpOfItsSensorIsAFault) {
  start_armed();
  measure(-90.0);
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_THAT(joint.reason(), HasSubstr("PositionSensor says that it moved by 0.4"));
  EXPECT_THAT(joint.reason(), HasSubstr("expected at most 0.04"));
  EXPECT_DOUBLE_EQ(position(), 1.0) << "as it was";
  EXPECT_DOUBLE_EQ(joint.output<control::LimitedPosition>("PositionActuator"), -90.0)
      << "the drive is to stay where its sensor says that it is";
  EXPECT_FALSE(armed());
}

TEST_F(PositionJoint, ASensorThatSaysNoNumberIsAFault) {
  start_armed();
  measure(kNan);
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_DOUBLE_EQ(joint.output<control::LimitedPosition>("PositionActuator"), -50.0);
  EXPECT_FALSE(armed());
}

TEST_F(PositionJoint, ACommandThatIsNoNumberIsAFault) {
  start_armed();
  told(kNan);
  EXPECT_EQ(joint.state(), State::kException);
  EXPECT_THAT(joint.reason(), HasSubstr("DesiredPosition is nan"));
  EXPECT_TRUE(std::isfinite(
      joint.output<control::LimitedPosition>(names_of(JointCommand::kPosition).actuator)));
}

TEST_F(PositionJoint, ASensorOfOneTurnIsFollowedAcrossItsEnd) {
  joint.set("SensorSign", 1.0);
  joint.set("GearRatio", 1.0);
  joint.set("InitialPos", 0.0);
  joint.set("SensorRange", 2.0);
  ASSERT_TRUE(joint.start()) << joint.reason();
  measure(1.99);
  EXPECT_NEAR(position(), -0.01, 1e-12) << "between minus and plus half of its range";
  measure(0.005);
  EXPECT_NEAR(position(), 0.005, 1e-12);
  EXPECT_EQ(joint.state(), State::kRunning);
}

TEST_F(PositionJoint, HasNoSignOfItsActuatorAndNeedsABoundOfItsError) {
  joint.set("ActuatorSign", -1.0);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("ActuatorSign must be 1"));
  joint.set("ActuatorSign", 1.0);
  joint.set("MaxPositionError", 0.0);
  EXPECT_THAT(std::string(joint.start().reason()), HasSubstr("MaxPositionError must be"));
}

// --- velocities --------------------------------------------------------------------------------

class VelocityJoint : public JointOfWay<JointCommand::kVelocity> {
 protected:
  VelocityJoint() : JointOfWay(0.2) {}
  double told(double command) { return JointOfWay::told<control::LimitedVelocity>(command); }
  /// At 1 rad, with a sensor of how far it turned.
  void start_armed() {
    start();
    joint.raise("Arm");
    for (int k = 0; k < 400 && !armed(); ++k) {
      told(0.0);
      sample();
    }
    ASSERT_TRUE(armed());
  }
};

TEST_F(VelocityJoint, ItsDriveGetsTheVelocityOfTheMotorAsFastAsItMayChange) {
  start_armed();
  EXPECT_NEAR(told(1.0), 5.0, 1e-9) << "MaxAcceleration in a period";
  EXPECT_NEAR(told(1.0), 10.0, 1e-9);
  for (int k = 0; k < 100; ++k) sample(told(9.0) * 0.01);
  EXPECT_NEAR(told(9.0), 200.0, 1e-9) << "MaxVelocity";
}

TEST_F(VelocityJoint, StopsBeforeItsEnd) {
  start_armed();
  for (int k = 0; k < 1000; ++k) sample(told(1.5) * 0.01);
  EXPECT_NEAR(position(), 4.5, 1e-6);
  EXPECT_LE(position(), 4.5 + 1e-9);
  EXPECT_TRUE(armed());
}

TEST_F(VelocityJoint, WhoseDriveDoesNotFollowForATenthOfASecondIsBrakedAndFaults) {
  start_armed();
  int periods = 0;
  for (; periods < 100 && armed(); ++periods) {
    told(1.0);
    sample(1e-9);
  }
  EXPECT_FALSE(armed());
  EXPECT_THAT(joint.reason(), HasSubstr("and was told"));
  EXPECT_GE(periods, 10);
  EXPECT_LE(periods, 20);
  EXPECT_EQ(joint.output<control::LimitedVelocity>("VelocityActuator"), 0.0);
}

TEST_F(VelocityJoint, WhosePositionStaysTheSameWhileItIsToldToMoveSlowlyFaults) {
  start_armed();
  int periods = 0;
  for (; periods < 200 && armed(); ++periods) {
    told(0.1);  // within MaxVelocityError
    sample();
  }
  EXPECT_FALSE(armed());
  EXPECT_THAT(joint.reason(), HasSubstr("to the bit while its drive was told to move it"));
  EXPECT_GE(periods, 20);
  EXPECT_LE(periods, 30);
}

TEST_F(VelocityJoint, WhoseDriveRoundsASlowVelocityToNoneStaysArmed) {
  start_armed();
  for (int k = 0; k < 2000; ++k) {
    told(0.015);
    sample();
  }
  EXPECT_TRUE(armed());
}

}  // namespace
}  // namespace armature::controllers
