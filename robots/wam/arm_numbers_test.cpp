// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/arm_numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

class Arms : public ::testing::TestWithParam<const ArmNumbers*> {
 protected:
  const ArmNumbers& arm = *GetParam();
};
INSTANTIATE_TEST_SUITE_P(Wam, Arms, ::testing::Values(&wam4(), &wam7()), name_of_arm);

TEST_P(Arms, HaveANumberForEachJointOfTheirDescription) {
  const auto links = dynamics_of(arm);
  ASSERT_EQ(links.joints(), arm.joints());
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    EXPECT_EQ(links.joint_names()[i], "joint" + std::to_string(i + 1));
  }
  EXPECT_EQ(arm.motors.size(), arm.joints());
  EXPECT_EQ(arm.gains.size(), arm.joints());
  EXPECT_EQ(transmission_of(arm).joints(), arm.joints());
}

TEST_P(Arms, TheMotorsAreWhereTheFactsHaveThemAtHome) {
  Vector motors(arm.joints());
  transmission_of(arm).motor_angles(arm.home, motors);
  motors.resize(4);
  EXPECT_THAT(motors, Pointwise(DoubleNear(1e-12), {0.0, -56.5, 56.5, -56.34}));
}

TEST(Wam, TheInverseOfTheTransmissionIsTheVendors) {
  const auto transmission = transmission_of(wam7());
  const double expected[7][7] = {{-0.02380952381, 0, 0, 0, 0, 0, 0},
                                 {0, 0.017699115044, -0.017699115044, 0, 0, 0, 0},
                                 {0, -0.029734471172, -0.029734471172, 0, 0, 0, 0},
                                 {0, 0, 0, -0.055555555556, 0, 0, 0},
                                 {0, 0, 0, 0, 0.051546391753, 0.051546391753, 0},
                                 {0, 0, 0, 0, -0.051546391753, 0.051546391753, 0},
                                 {0, 0, 0, 0, 0, 0, -0.066979236437}};
  for (std::size_t motor = 0; motor < 7; ++motor) {
    Vector motors(7, 0.0), joints(7);
    motors[motor] = 1.0;
    transmission.joint_angles(motors, joints);
    for (std::size_t joint = 0; joint < 7; ++joint) {
      EXPECT_NEAR(joints[joint], expected[joint][motor], 1e-12);
    }
  }
}

TEST(Wam, ANewtonMeterAtEachJointIsWhatTheFactsHaveAtTheMotors) {
  Vector motors(7);
  transmission_of(wam7()).motor_torques(Vector(7, 1.0), motors);
  EXPECT_THAT(motors, Pointwise(DoubleNear(5e-7), {-0.02381, -0.012035, -0.047434, -0.055556, 0.0,
                                                   0.103093, -0.066979}));
}

TEST(Wam, TheRotorsAtTheJointsAreWhatTheFactsDeriveAndTheUnequalOnesOfTheWristCoupleIt) {
  const auto transmission = transmission_of(wam7());
  const Vector expected{0.20517084,  0.18883754875, 0.066906917344, 0.03462264,
                        0.003227287, 0.003227287,   0.000316524958};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(transmission.rotor_inertia(i, i), expected[i], 1e-12);
  }
  EXPECT_NEAR(transmission.rotor_inertia(4, 5), 9.7 * 9.7 * (1.745e-5 - 1.685e-5), 1e-15);
  EXPECT_NEAR(transmission.rotor_inertia(1, 2), 0.0, 1e-15) << "those of the shoulder are equal";
}

}  // namespace
}  // namespace armature::wam
