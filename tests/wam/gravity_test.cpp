// SPDX-License-Identifier: Apache-2.0
// Compensation of gravity alone holds the simulated arm anywhere in its range.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/wam/bench_arm.hpp"

namespace armature::wam {
namespace {

using Vector = std::vector<double>;

class Gravity : public ::testing::TestWithParam<int> {
 protected:
  Gravity() {
    base::Diagnostics diagnostics;
    links_ = control::InverseDynamics::load(urdf_, {.gravity = {0.0, 0.0, -kGravity}}, diagnostics);
  }
  /// Somewhere between the stops; the same poses in every run.
  Vector pose() {
    const double lower[] = {-2.6, -2.0, -2.8, -0.9, -4.76, -1.6, -3.0};
    const double upper[] = {2.6, 2.0, 2.8, 3.1, 1.24, 1.6, 3.0};
    Vector q(arm_.joints());
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] = lower[i] + (upper[i] - lower[i]) * share_(engine_);
    }
    return q;
  }
  enum class Steps { kNone, kOfPucks, kOfPucksRoundedDown };
  /// How far a joint moves in 10 s, without any friction but the motors' [rad].
  double drift(const Vector& start, Steps steps) {
    auto made = ArmSimulation::load(arm_, {.urdf_file = urdf_, .start = start});
    EXPECT_TRUE(made.ok()) << made.error();
    ArmSimulation& simulation = made.value();
    PuckTorques pucks(start.size());
    for (int cycle = 0; cycle < 5000; ++cycle) {
      // Pucks that are new in each cycle know nothing of what they left of the torques before.
      if (steps == Steps::kOfPucksRoundedDown) pucks = PuckTorques(start.size());
      compensate(simulation, steps == Steps::kNone ? nullptr : &pucks);
      simulation.advance(std::chrono::milliseconds(2));
    }
    double most = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      most = std::max(most, std::abs(simulation.joint_position(i) - start[i]));
    }
    return most;
  }

  const ArmNumbers& arm_ = arm_of(GetParam());

 private:
  void compensate(ArmSimulation& simulation, PuckTorques* pucks) {
    Vector motors(arm_.joints()), joints(arm_.joints()), torques(arm_.joints());
    for (std::size_t i = 0; i < motors.size(); ++i) {
      motors[i] = pucks != nullptr ? rounded_angle(simulation.angle(i)) : simulation.angle(i);
    }
    transmission_.joint_angles(motors, joints);
    links_->gravity(joints, torques);
    transmission_.motor_torques(torques, motors);
    for (std::size_t i = 0; i < motors.size(); ++i) {
      simulation.set_torque(i, pucks != nullptr ? pucks->step(i, motors[i]) : motors[i]);
    }
  }

  const std::string urdf_ = std::string(WAM "/") + std::string(arm_.urdf);
  const control::Transmission transmission_ =
      control::Transmission::make(arm_.transmission).value();
  std::optional<control::InverseDynamics> links_;
  std::mt19937 engine_{10};
  std::uniform_real_distribution<double> share_{0.02, 0.98};
};
INSTANTIATE_TEST_SUITE_P(Wam, Gravity, ::testing::Values(4, 7));

constexpr int kPoses = 6;
constexpr double kBound = 0.01;

TEST_P(Gravity, CompensatedHoldsTheArmForTenSecondsAnywhere) {
  for (int i = 0; i < kPoses; ++i) EXPECT_LT(drift(pose(), Steps::kNone), kBound);
}

TEST_P(Gravity, CompensatedInTheStepsOfPucksHoldsItAsWell) {
  for (int i = 0; i < kPoses; ++i) EXPECT_LT(drift(pose(), Steps::kOfPucks), kBound);
}

TEST_P(Gravity, TorquesThatAreRoundedDownAloneDoNotHoldIt) {
  EXPECT_GT(drift(pose(), Steps::kOfPucksRoundedDown), 5.0 * kBound);
}

}  // namespace
}  // namespace armature::wam
