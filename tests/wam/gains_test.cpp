// SPDX-License-Identifier: Apache-2.0
// What of gains, limits and gravity the check of a deployment of the arm refuses.
#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What the check says of a deployment.
std::string said(const std::string& file, std::vector<std::string> overrides = {}) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(std::string(WAM "/deployments/") + file, options)
      .diagnostics.to_text();
}

TEST(ArmCheck, FindsNothingInAnyDeploymentOfTheArm) {
  for (const char* joints : {"4", "7"}) {
    for (const char* controller :
         {"npid", "computed_torque", "gravity_pd", "controller_wam", "modes"}) {
      EXPECT_EQ(said(std::string(controller) + joints + ".yaml"), "") << controller << joints;
    }
  }
  for (const char* file : {"npid_feed_forward7.yaml", "controller_wam_velocities7.yaml",
                           "online7.yaml", "sample_port7.yaml", "tool7.yaml"}) {
    EXPECT_EQ(said(file), "") << file;
  }
}

TEST(ArmCheck, RefusesGainsThatWouldShakeTheArmThatIsHeldWithTheirFigures) {
  EXPECT_THAT(said("npid7.yaml", {"WAM.Kp=[900, 2500, 600, 500, 5000, 50, 8]"}),
              AllOf(HasSubstr("'WAM': joint 5: Kp 5000, Ki 0.5, Kd 0.5, with which it is held: "
                              "shakes at "),
                    HasSubstr("give at most 0.0"), HasSubstr("sampled every 2 ms")));
  EXPECT_THAT(said("npid4.yaml", {"WAM.Kd=[10, 20, 100, 2.5]"}), HasSubstr("joint 3: Kp 600"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.Ki=[2500, 5, 2, 0.5, 1e5, 0.5, 0.1]"}),
              HasSubstr("with which it is held"));
}

TEST(ArmCheck, RefusesAPeriodWithWhichTheGainsShakeIt) {
  EXPECT_THAT(said("controller_wam7.yaml",
                   {"period=8 ms", "WAM.MaxTorqueGrowth=[14, 14, 11, 7, 2.5, 2.5, 0.5]"}),
              HasSubstr("sampled every 8 ms"));
}

TEST(ArmCheck, RefusesGainsThatCouldNotHoldItsWeight) {
  EXPECT_THAT(said("npid7.yaml", {"WAM.Kp=[900, 2.5, 600, 500, 50, 50, 8]"}),
              HasSubstr("joint 2: Kp is 2.5 Nm/rad, expected at least "));
}

TEST(ArmCheck, RefusesGainsOfEveryController) {
  EXPECT_THAT(said("npid7.yaml", {"PID5.Kd=2500"}), HasSubstr("'PID5': joint 5 of WAM: shakes at"));
  EXPECT_THAT(said("computed_torque7.yaml",
                   {"position_gains=[1600, 1600, 2500, 2500, 3600, 360000, 3600]"}),
              HasSubstr("'Controller': joint 6 of WAM: shakes at"));
  EXPECT_THAT(said("computed_torque7.yaml", {"rotor_inertia=[1.1631e-4, 1.1831e-4, 1.1831e-4, "
                                             "1.0686e-4, 1.685e-5, 1.745e-5, 1.42e-4]"}),
              HasSubstr("'Controller': joint 7 of WAM: shakes at"));
  EXPECT_THAT(said("gravity_pd4.yaml", {"Controller.Kd=[40, 80, 40, 9]"}),
              HasSubstr("'Controller': joint 3 of WAM: "));
  EXPECT_THAT(said("modes7.yaml", {"ControllerCT.Kd=[80, 80, 100, 100, 9600, 96, 96]"}),
              HasSubstr("'ControllerCT': joint 5 of WAM: shakes at"));
}

TEST(ArmCheck, RefusesLimitsBeyondArmAndMotors) {
  EXPECT_THAT(said("npid7.yaml", {"WAM.MaxVelocity=[1e9]"}),
              HasSubstr("joint 1: MaxVelocity is 1e+09 rad/s, the arm allows 2.5 rad/s"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.PositionMax=[26, 2.05, 2.8, 3.2, 1.24, 1.6, 3.0]"}),
              HasSubstr("joint 1: PositionMax is 26 rad, the joint ends at 2.67 rad"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.PositionMin=[-2.6, -20, -2.8, -0.95, -4.76, -1.6, -3.0]"}),
              HasSubstr("joint 2: minus PositionMin is 20 rad, the joint ends at 2.07 rad"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.MaxTorque=[60, 60, 45, 28, 10, 10, 1300]"}),
              HasSubstr("joint 7: MaxTorque is 1300 Nm, its motors give 1.394 Nm"));
  EXPECT_THAT(said("npid4.yaml", {"WAM.MaxControlTorque=[50, 50, 35, 2500]"}),
              HasSubstr("joint 4: MaxControlTorque is 2500 Nm, MaxTorque 28 Nm"));
  EXPECT_THAT(said("npid4.yaml", {"WAM.MaxTorqueGrowth=[5000]"}), HasSubstr("MaxTorqueGrowth is"));
  EXPECT_THAT(said("npid4.yaml", {"WAM.MaxAcceleration=[500]"}),
              HasSubstr("the torque of MaxAcceleration and its weight is"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.MaxTorque=[60, 6, 45, 28, 10, 10, 1.3]"}),
              HasSubstr("joint 2: MaxControlTorque is 50 Nm, MaxTorque 6 Nm"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.MaxVelocity=[.nan]"}),
              HasSubstr("expected a finite number"));
  EXPECT_THAT(said("npid7.yaml", {"PID7.UMax=50"}),
              HasSubstr("'PID7': UMin and UMax are up to 50, joint 7 of WAM takes 1.3"));
}

TEST(ArmCheck, RefusesAGravityThatIsNotTheArms) {
  EXPECT_THAT(said("npid7.yaml", {"WAM.gravity=[0, 0, -98.05]"}),
              HasSubstr("gravity is [0, 0, -98.05] m/s^2, in size 98.05, expected 9.7 to 9.9"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.gravity=[0, 0, 9.805]"}),
              HasSubstr("expected [0, 0, -9.805]: the emulated arm stands upright"));
  EXPECT_THAT(said("npid7.yaml", {"WAM.gravity=[0, 0, 0]"}),
              HasSubstr("the arm holds its weight itself"));
  EXPECT_THAT(said("npid7.yaml", {"bus=can0", "WAM.gravity=[9.805, 0, 0]"}),
              HasSubstr("or other_mounting: true"));
  EXPECT_THAT(
      said("npid7.yaml", {"bus=can0", "WAM.gravity=[9.805, 0, 0]", "WAM.other_mounting=true"}),
      ::testing::Not(HasSubstr("gravity")));
}

TEST(ArmCheck, RefusesFrictionThatTheMotorsDoNotHave) {
  EXPECT_THAT(said("computed_torque7.yaml", {"viscous_friction=[720]"}),
              AllOf(HasSubstr("'Controller': joint 1 of WAM: motor_viscous_friction is 1.27e+06 Nm "
                              "s/rad at the joint, expected at most 1.907"),
                    HasSubstr("as its drive has 1.272")));
}

TEST(ArmCheck, RefusesANumberOfJointsThatNoArmHas) {
  EXPECT_THAT(said("modes4.yaml", {"WAM.joints=1000000000"}), HasSubstr("outside 1 .. 100"));
}

TEST(ArmCheck, RefusesAGravityThatIsNoNumber) {
  for (const char* none : {".inf", "-.inf"}) {
    EXPECT_THAT(said("modes4.yaml", {"ControllerCT.gravity=[" + std::string(none) + ", 0, 0]"}),
                HasSubstr("'ControllerCT'"));
    EXPECT_THAT(said("npid4.yaml", {"WAM.gravity=[0, 0, " + std::string(none) + "]"}),
                HasSubstr("'WAM'"));
  }
}

TEST(ArmCheck, RefusesAWeightThatIsDrivenTwiceOrByNobody) {
  EXPECT_THAT(said("computed_torque7.yaml", {"controller_has_gravity=false"}),
              HasSubstr("its weight would be driven twice"));
  EXPECT_THAT(said("gravity_pd4.yaml", {"Controller.gravity=[0, 0, 0]"}),
              AllOf(HasSubstr("its weight of up to "), HasSubstr(" Nm is not held: gravity is 0")));
  EXPECT_THAT(said("computed_torque4.yaml", {"Controller.gravity=[0, 9.805, 0]"}),
              HasSubstr("that of its hardware [0, 0, -9.805] m/s^2"));
}

TEST(ArmCheck, RefusesAWeightThatIsLeftToAControllerWithoutAModelOfIt) {
  for (const char* file : {"npid7.yaml", "controller_wam7.yaml", "npid4.yaml"}) {
    EXPECT_THAT(
        said(file, {"controller_has_gravity=true"}),
        AllOf(HasSubstr("'Controller': joint 2 of WAM: "), HasSubstr("its weight of up to "),
              HasSubstr(
                  "Nm is not held: its controller has no model of it, and the hardware leaves it")))
        << file;
  }
  EXPECT_THAT(said("modes7.yaml", {"controller_has_gravity=true"}),
              AllOf(HasSubstr("its controller has no model of it"),
                    HasSubstr("'ControllerCT': joint 2 of WAM: its weight of up to "),
                    HasSubstr(" Nm is not held: ")));
}

TEST(ArmCheck, RefusesTorquesThatGrowTooSlowlyToHoldTheArm) {
  EXPECT_THAT(said("gravity_pd4.yaml", {"WAM.MaxTorqueGrowth=[5, 5, 0.04, 3]"}),
              HasSubstr("'WAM': joint 3: MaxTorqueGrowth is 0.04 Nm in a period, expected at least "
                        "2.25, so that MaxTorque of 45 Nm is there within 40 ms"));
}

TEST(ArmCheck, GoesOnAfterTheCheckForWhatIsChanged) {
  Arm arm("npid7.yaml");
  const auto refusal = [&](const char* component, const char* property, const auto& value) {
    const auto set = arm.application().set_property(component, property, types::Value::of(value));
    return set ? std::string() : set.error();
  };
  EXPECT_THAT(refusal("WAM", "Kp", Vector{9e5, 2500, 600, 500, 50, 50, 8}),
              AllOf(HasSubstr("property 'Kp' of 'WAM' cannot be"), HasSubstr("joint 1: Kp 9e+05")));
  EXPECT_THAT(refusal("WAM", "MaxVelocity", Vector{1e9}), HasSubstr("the arm allows 2.5 rad/s"));
  EXPECT_EQ(refusal("WAM", "Kp", Vector{800, 2500, 600, 500, 50, 50, 8}), "");
  EXPECT_THAT(refusal("WAM", "ControllerHasGravity", true),
              HasSubstr("controllers were checked for the weight that it leaves to them"));
  EXPECT_EQ(refusal("WAM", "ControllerHasGravity", false), "");
  EXPECT_THAT(refusal("WAM", "gravity", std::array<double, 3>{0.0, 0.0, 0.0}),
              HasSubstr("property 'gravity' of 'WAM' cannot change: "));
  EXPECT_THAT(refusal("WAM", "MaxTorqueGrowth", Vector{0.05}),
              HasSubstr("MaxTorqueGrowth is 0.05 Nm"));
  arm.start_armed();
  EXPECT_THAT(refusal("PID5", "Kp", 1e9), HasSubstr("joint 5 of WAM: unstable"));
  EXPECT_THAT(refusal("PID5", "Kd", 2500.0), HasSubstr("joint 5 of WAM: shakes at"));
  EXPECT_THAT(refusal("PID5", "Kd", 500.0), HasSubstr("gain margin 1."));
  EXPECT_EQ(refusal("PID5", "Kp", 40.0), "");
}

}  // namespace
}  // namespace armature::wam
