// SPDX-License-Identifier: Apache-2.0
// A joint controller over driver, bus and pucks, beside a simulation that has none of them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "robots/wam/driver/test_hosted_bench.hpp"
#include "robots/wam/driver/wam_driver.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

constexpr double kGear = -18.0;  // of motor 4
constexpr double kInertia = 1.0686e-4;
constexpr double kStart = 3.13;
constexpr double kGoal = 3.03;
constexpr double kPeriod = 0.002;
constexpr int kCycles = 500;

/// The controller of joint 4: the integral is that of the error before.
class Pid {
 public:
  double step(double error) {
    integral_ += 0.5 * kPeriod * last_;
    const double output = 500.0 * error + integral_ + 2.5 * (error - last_) / kPeriod;
    last_ = error;
    return std::clamp(output, -15.0, 15.0);
  }

 private:
  double integral_ = 0.0;
  double last_ = 0.0;
};

double counted(double motor_angle, double offset) {
  const double count = 2.0 * std::numbers::pi / 4096.0;
  return std::floor(motor_angle / count) * count + offset;
}

/// The rotor in steps of a microsecond; the position is what it was when the request had been sent,
/// the torque works from the end of its frame on.
std::vector<double> simulate(base::Duration sampled_after, base::Duration driven_after) {
  const auto micros = [](base::Duration time) { return static_cast<int>(time / 1us); };
  const double home =
      std::floor(-56.34 / (2.0 * std::numbers::pi) * 4096.0) / 4096.0 * 2.0 * std::numbers::pi;
  double angle = 0.0;
  double velocity = 0.0;
  double torque = 0.0;
  double next_torque = 0.0;
  Pid pid;
  std::vector<double> joint;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    for (int t = 0; t < 2000; ++t) {
      if (t == micros(sampled_after)) {
        joint.push_back(counted(angle, home) / kGear);
        const double wanted = pid.step(kGoal - joint.back()) / kGear;
        next_torque = std::floor(wanted * 2700.0) / 2700.0;
      }
      if (t == micros(driven_after)) torque = next_torque;
      velocity += torque / kInertia * 1e-6;
      angle += velocity * 1e-6;
    }
  }
  return joint;
}

TEST(WamClosedLoop, AStepOfJoint4IsAsSimulatedWithoutBusAndPucks) {
  Hosted bench(4);
  bench.start_active();
  bench.tell("00A#AE0000000000");  // the step is faster than the board lets pass
  bench.log.clear();
  Pid pid;
  std::vector<double> joint;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    const base::Time next = bench.now() + Hosted::kPeriod;
    ASSERT_EQ(bench.read(), WamReading::kComplete);
    joint.push_back(bench.driver->motor(3).position / kGear);
    bench.driver->set_torque(3, pid.step(kGoal - joint.back()) / kGear, bench.now());
    bench.driver->send_torques(bench.now());
    bench.emulator->advance_to(next);
  }
  const auto& first = bench.log;
  const base::Time begin = first.front().begin;
  const auto torques =
      std::ranges::find_if(first, [](const auto& event) { return event.frame.id == 0x401; });
  ASSERT_NE(torques, first.end());
  const auto expected = simulate(first.front().end - begin, torques->end - begin);
  EXPECT_NEAR(joint.front(), kStart, 1e-3);
  double most = 0.0;
  for (std::size_t i = 0; i < joint.size(); ++i) {
    most = std::max(most, std::abs(joint[i] - expected[i]));
  }
  EXPECT_LT(most, 5e-4) << "of a step of 0.1 rad";
  EXPECT_LT(*std::ranges::min_element(joint), kGoal - 0.005) << "it overshoots";
  EXPECT_NEAR(joint.back(), kGoal, 1e-3);
  EXPECT_TRUE(bench.driver->active());
}

}  // namespace
}  // namespace armature::wam
