// SPDX-License-Identifier: Apache-2.0
// The real-time functions of sim.
#include <chrono>
#include <cstdint>
#include <limits>
#include <utility>

#include "armature/sim/brake.hpp"
#include "armature/sim/encoder.hpp"
#include "armature/sim/index_switch.hpp"
#include "armature/sim/motor.hpp"
#include "armature/sim/plant.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::sim {
namespace {

using namespace std::chrono_literals;

Plant make_wheel() {
  auto made = Plant::parse(
      "<robot name='wheel'><link name='base'/>"
      "<joint name='axle' type='continuous'><parent link='base'/><child link='wheel'/>"
      "<dynamics damping='0.1' friction='0.1'/></joint><link name='wheel'><inertial>"
      "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
      "</link></robot>",
      "wheel.urdf", {});
  EXPECT_TRUE(made.ok()) << made.error();
  return std::move(made).value();
}

TEST(RealtimeSim, APlantWithABrake) {
  Plant plant = make_wheel();
  Brake brake(plant, 0, 10.0);
  expect_realtime("Brake::release", [&] { brake.release(); });
  expect_realtime("Plant::set_effort", [&] { plant.set_effort(0, 1.0); });
  expect_realtime("Plant::step", [&] { plant.step(1ms); });
  EXPECT_GT(plant.velocity(0), 0.0);
  expect_realtime("Brake::apply", [&] { brake.apply(); });
  expect_realtime("Plant::set_brake", [&] { plant.set_brake(0, 5.0); });
  plant.set_effort(0, std::numeric_limits<double>::quiet_NaN());
  expect_realtime("Plant::step", [&] { plant.step(1ms); });
  EXPECT_EQ(plant.status(), PlantStatus::kDiverged) << "it is told without a word, too";
}

TEST(RealtimeSim, AMotorWithItsEncoder) {
  auto made =
      Motor::make({.motor = {.resistance_ohm = 2.0, .torque_constant = 0.035, .gear_ratio = 100.0},
                   .supply = 12.0});
  Motor& motor = made.value();
  double torque = 0.0;
  double current = 0.0;
  expect_realtime("Motor::set_voltage", [&] { motor.set_voltage(12.0); });
  expect_realtime("Motor::torque", [&] { torque = motor.torque(0.0); });
  expect_realtime("Motor::current", [&] { current = motor.current(0.0); });
  expect_realtime("Motor::switch_off", [&] { motor.switch_off(); });
  EXPECT_DOUBLE_EQ(torque, 21.0);
  EXPECT_DOUBLE_EQ(current, 6.0);

  Encoder encoder(2000.0, 100.0);
  std::int64_t count = 0;
  std::int64_t moved = 0;
  expect_realtime("Encoder::restart", [&] { encoder.restart(0.0); });
  expect_realtime("Encoder::count", [&] { count = encoder.count(1.0); });
  expect_realtime("Encoder::displacement", [&] { moved = encoder.displacement(1.0); });
  EXPECT_EQ(count, 31831);
  EXPECT_EQ(moved, 0) << "the first of the calls took it";

  const IndexSwitch index{.centre = 0.0, .half_width = 0.01};
  bool closed = false;
  expect_realtime("IndexSwitch::closed", [&] { closed = index.closed(0.0); });
  EXPECT_TRUE(closed);
}

}  // namespace
}  // namespace armature::sim
