// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/motor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const Motor::Config kConfig{.motor = {.resistance_ohm = 2.0,
                                      .torque_constant = 0.035,
                                      .gear_ratio = 100.0,
                                      .viscous_friction = 0.02,
                                      .coulomb_friction = 0.08,
                                      .coulomb_velocity = 0.0,
                                      .rotor_inertia = 1.2e-5},
                            .supply = 12.0};

Motor make() { return Motor::make(kConfig).value(); }

TEST(Motor, AtRestTheWindingAloneLimitsTheCurrent) {
  Motor motor = make();
  motor.set_voltage(6.0);
  EXPECT_DOUBLE_EQ(motor.current(0.0), 3.0);
  EXPECT_DOUBLE_EQ(motor.torque(0.0), 3.0 * 0.035 * 100.0) << "friction is the plant's";
}

TEST(Motor, WithoutVoltageTheBackEmfBrakes) {
  Motor motor = make();
  motor.set_voltage(0.0);
  EXPECT_DOUBLE_EQ(motor.current(1.0), -3.5 / 2.0);
  EXPECT_DOUBLE_EQ(motor.torque(1.0), -3.5 * 3.5 / 2.0);
}

TEST(Motor, SwitchedOffItHasNoCurrentAtAnySpeed) {
  Motor motor = make();
  EXPECT_EQ(motor.torque(1.0), 0.0) << "off at the beginning";
  motor.set_voltage(12.0);
  motor.switch_off();
  EXPECT_EQ(motor.current(1.0), 0.0);
  EXPECT_EQ(motor.torque(1.0), 0.0);
}

TEST(Motor, NoMoreThanTheSupplyIsApplied) {
  Motor motor = make();
  motor.set_voltage(100.0);
  EXPECT_DOUBLE_EQ(motor.current(0.0), 6.0);
  motor.set_voltage(-100.0);
  EXPECT_DOUBLE_EQ(motor.current(0.0), -6.0);
}

TEST(Motor, TheRotorAddsToTheJointsInertia) { EXPECT_DOUBLE_EQ(make().armature(), 0.12); }

TEST(Motor, ARefusedConfigurationNamesEveryFieldThatIsWrong) {
  Motor::Config config = kConfig;
  config.supply = 0.0;
  EXPECT_THAT(Motor::make(config).error(), HasSubstr("Motor: supply is 0"));
  config.motor.gear_ratio = 0.0;
  EXPECT_THAT(Motor::make(config).error(),
              AllOf(HasSubstr("gear_ratio is 0"), HasSubstr("supply is 0")));
}

}  // namespace
}  // namespace armature::sim
