// SPDX-License-Identifier: Apache-2.0
// The real-time functions of control.
#include <array>
#include <chrono>

#include "armature/control/dc_motor.hpp"
#include "armature/control/error_metrics.hpp"
#include "armature/control/pid.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;

TEST(RealtimeFunctions, Pid) {
  auto pid = control::Pid::make({.kp = 1.0, .ki = 0.1, .kd = 0.1, .u_min = -5.0, .u_max = 5.0});
  double output = 0.0;
  expect_realtime("Pid::step", [&] { output = pid.value().step(0.1); });
  EXPECT_GT(output, 0.0);
  expect_realtime("Pid::reset_to", [&] { pid.value().reset_to(2.0); });
  EXPECT_EQ(pid.value().state().output, 2.0);
  expect_realtime("Pid::reset", [&] { pid.value().reset(); });
  EXPECT_EQ(pid.value().state().output, 0.0);
}

TEST(RealtimeFunctions, ErrorMetrics) {
  auto metrics = control::ErrorMetrics::make({2, 10ms});
  expect_realtime("ErrorMetrics::step", [&] { metrics.value().step(std::array{0.1, -0.1}); });
  EXPECT_EQ(metrics.value().samples(), 101u);
  expect_realtime("ErrorMetrics::reset", [&] { metrics.value().reset(); });
  EXPECT_EQ(metrics.value().samples(), 0u);
}

TEST(RealtimeFunctions, DcMotor) {
  const auto made = control::DcMotor::make(
      {.resistance_ohm = 2.0, .torque_constant = 0.035, .gear_ratio = 100.0});
  const auto& motor = made.value();
  double value = 0.0;
  expect_realtime("DcMotor::voltage", [&] { value = motor.voltage(1.0, 0.0); });
  expect_realtime("DcMotor::torque", [&] { value = motor.torque(value, 0.0); });
  expect_realtime("DcMotor::current", [&] { value = motor.current(2.0, 0.0); });
  EXPECT_EQ(value, 1.0);
  expect_realtime("DcMotor::friction", [&] { value = motor.friction(1.0); });
  expect_realtime("DcMotor::reflected_inertia", [&] { value = motor.reflected_inertia(); });
  EXPECT_EQ(value, 0.0);
}

}  // namespace
}  // namespace armature
