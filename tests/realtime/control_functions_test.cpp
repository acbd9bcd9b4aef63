// SPDX-License-Identifier: Apache-2.0
// The real-time functions of control.
#include "armature/control/pid.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature {
namespace {

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

}  // namespace
}  // namespace armature
