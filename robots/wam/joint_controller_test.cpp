// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/joint_controller.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

/// The formulas of the vendor's controller as its facts have them, for one joint.
class ByHand {
 public:
  explicit ByHand(const JointGains& gains) : gains_(gains) {}
  double step(double e) {
    integral_ += gains_.ki * kPeriod * e_previous_;
    const double u = gains_.kp * e + integral_ + gains_.kd * (e - e_previous_) / kPeriod;
    e_previous_ = e;
    return std::min(std::max(u, -gains_.max_torque), gains_.max_torque);
  }

 private:
  JointGains gains_;
  double integral_ = 0.0;
  double e_previous_ = 0.0;
};

class WamController : public ::testing::TestWithParam<const ArmNumbers*> {
 protected:
  JointController make() const {
    auto made = JointController::make({.gains = arm.gains});
    EXPECT_TRUE(made.ok()) << made.error();
    return std::move(made).value();
  }
  const ArmNumbers& arm = *GetParam();
};
INSTANTIATE_TEST_SUITE_P(Wam, WamController, ::testing::Values(&wam4(), &wam7()), name_of_arm);

TEST_P(WamController, IsTheFormulasOfTheFactsAlsoAtItsLimits) {
  JointController controller = make();
  std::vector<ByHand> by_hand(arm.gains.begin(), arm.gains.end());
  Vector reference(arm.joints()), measured(arm.joints()), torques(arm.joints());
  int limited = 0;
  for (int k = 0; k < 2000; ++k) {
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      reference[i] = 0.02 * std::sin(0.01 * k + static_cast<double>(i));
      measured[i] = 0.02 * std::cos(0.013 * k);
    }
    controller.step(reference, measured, torques);
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      ASSERT_NEAR(torques[i], by_hand[i].step(reference[i] - measured[i]), 1e-9);
      if (std::abs(torques[i]) == arm.gains[i].max_torque) ++limited;
    }
  }
  EXPECT_GT(limited, 100);
  EXPECT_LT(limited, 2000 * static_cast<int>(arm.joints()));
}

TEST_P(WamController, AfterAResetItBeginsAsAtFirst) {
  JointController controller = make();
  const Vector reference(arm.joints(), 0.004), measured(arm.joints(), 0.003);
  Vector first(arm.joints()), again(arm.joints());
  controller.step(reference, measured, first);
  for (int i = 0; i < 100; ++i) controller.step(reference, Vector(arm.joints(), 0.0), again);
  controller.reset();
  controller.step(reference, measured, again);
  EXPECT_EQ(again, first);
}

TEST_P(WamController, ResetToWhereTheArmIsItDoesNotKick) {
  JointController controller = make();
  const Vector reference(arm.joints(), 0.004), measured(arm.joints(), 0.003);
  Vector torques(arm.joints());
  controller.reset_to(reference, measured);
  controller.step(reference, measured, torques);
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    EXPECT_NEAR(torques[i], (arm.gains[i].kp + arm.gains[i].ki * kPeriod) * 0.001, 1e-12);
  }
}

TEST_P(WamController, VelocitiesOfTheReferenceCountInsteadOfItsDifferences) {
  JointController by_positions = make();
  JointController by_velocities = make();
  const double speed = 0.1;
  Vector reference(arm.joints(), 0.0), measured(arm.joints(), 0.0), velocities(arm.joints(), speed);
  Vector expected(arm.joints()), torques(arm.joints());
  by_positions.reset_to(reference, measured);
  by_velocities.reset_to(reference, measured);
  for (int k = 0; k < 200; ++k) {
    by_positions.step(reference, measured, expected);
    by_velocities.step(reference, velocities, measured, torques);
    // A reference that moves evenly has the same differences.
    if (k > 0) {
      EXPECT_LT(largest_difference(torques, expected), 1e-9) << k;
    }
    for (std::size_t i = 0; i < arm.joints(); ++i) {
      reference[i] = speed * kPeriod * (k + 1);
      measured[i] = reference[i] - 1e-4 * std::sin(0.1 * k);
    }
  }
  // One whose positions come in steps, at another rate, does not kick with them.
  const Vector before = torques;
  for (double& each : reference) each += 1e-3;
  by_velocities.step(reference, velocities, measured, torques);
  for (std::size_t i = 0; i < arm.joints(); ++i) {
    EXPECT_LT(std::abs(torques[i] - before[i]), arm.gains[i].kp * 2e-3) << i;
  }
}

TEST_P(WamController, WithVelocitiesTheFirstStepDoesNotKick) {
  JointController controller = make();
  const Vector place(arm.joints(), 0.3), velocities(arm.joints(), 1.0);
  Vector torques(arm.joints());
  controller.reset_to(place, place);
  controller.step(place, velocities, place, torques);
  EXPECT_EQ(torques, Vector(arm.joints(), 0.0));
}

TEST_P(WamController, AllocatesNothing) {
  JointController controller = make();
  const Vector reference(arm.joints(), 0.004), measured(arm.joints(), 0.003);
  Vector torques(arm.joints());
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    controller.step(reference, measured, torques);
    controller.reset_to(reference, measured);
    controller.reset();
  });
  EXPECT_EQ(violations, 0u) << guard.report();
}

TEST(WamControllerGains, ThatCannotBeAreNamedWithTheirJoint) {
  EXPECT_EQ(JointController::make({.gains = {{.kp = 1.0}, {.kp = -1.0}}}).error(),
            "joint 2: PositionalPid: kp is -1, expected a finite number of at least 0");
}

}  // namespace
}  // namespace armature::wam
