// SPDX-License-Identifier: Apache-2.0
// The real-time functions of sim.
#include <chrono>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "armature/sim/brake.hpp"
#include "armature/sim/encoder.hpp"
#include "armature/sim/index_switch.hpp"
#include "armature/sim/motor.hpp"
#include "armature/sim/plant.hpp"
#include "armature/sim/ray_camera.hpp"
#include "armature/sim/world.hpp"
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

const char* const kBallOnFloor =
    "<mujoco><worldbody><geom type='plane' size='1 1 1'/>"
    "<camera name='eye' pos='0 0 2'/>"
    "<body name='ball' pos='0 0 0.5'><freejoint/><geom type='sphere' size='0.1'/>"
    "<body name='hand' pos='0.2 0 0'><joint name='wrist' axis='0 0 1'/>"
    "<geom type='box' size='0.05 0.05 0.05'/></body></body></worldbody></mujoco>";

TEST(RealtimeSim, AWorldOfBodiesThatTouch) {
  auto made = World::parse(kBallOnFloor, "ball", {});
  ASSERT_TRUE(made) << made.error();
  World& world = made.value();
  const std::size_t ball = *world.find_body("ball");
  const std::size_t wrist = *world.find_joint("wrist");
  Pose pose;
  expect_realtime("World::set_effort", [&] { world.set_effort(wrist, 0.001); });
  expect_realtime("World::step", [&] { world.step(10ms); });
  expect_realtime("World::pose", [&] { pose = world.pose(ball); });
  expect_realtime("World::place", [&] { world.place(ball, pose); });
  EXPECT_LT(pose.position[2], 0.2) << "it fell";
}

TEST(RealtimeSim, ACamera) {
  auto made = RayCamera::parse(kBallOnFloor, "ball",
                               {.camera = "eye", .width = 16, .height = 12, .noise = 2.0});
  ASSERT_TRUE(made) << made.error();
  RayCamera& camera = made.value();
  const std::size_t ball = *camera.find_body("ball");
  std::vector<std::uint8_t> image;
  camera.render(0, image);
  const std::vector<std::uint8_t> before = image;
  expect_realtime("RayCamera::place", [&] { camera.place(ball, {{0.3, 0.0, 1.0}, {1, 0, 0, 0}}); });
  expect_realtime("RayCamera::render", [&] { camera.render(0, image); });
  EXPECT_NE(image, before);
}

}  // namespace
}  // namespace armature::sim
