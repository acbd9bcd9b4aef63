// SPDX-License-Identifier: Apache-2.0
// Joints whose drives take torques, or follow velocities or positions, and their controllers.
#include <memory>
#include <vector>

#include "armature/controllers/controller_following/controller_position.hpp"
#include "armature/controllers/controller_following/controller_velocity.hpp"
#include "armature/controllers/joint/joint.hpp"
#include "armature/testing/harness.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::controllers {
namespace {

using Vector = std::vector<double>;

/// Armed where it is, driven, disarmed, again and again; then its sensor jumps.
template <JointCommand kWay>
void expect_joint(double holding) {
  testing::Harness joint(std::make_unique<JointOf<kWay>>("Joint1"));
  const JointCommandNames& names = names_of(kWay);
  joint.set("PeerName", "Card");
  joint.set("Brake", true);
  joint.set("GearRatio", 1.0);
  joint.set("PositionMin", -1e6);
  joint.set("PositionMax", 1e6);
  joint.set("MaxVelocity", 10.0);
  joint.set("MaxAcceleration", 100.0);
  joint.set(names.limit, 12.0);
  joint.set("Period", 0.001);
  for (const char* name : {"actuatorOff", "brakeApply", "sensorRead"}) {
    joint.serve<bool()>(name, [] { return true; });
  }
  for (const char* name : {"actuatorOn", "brakeRelease"}) {
    joint.serve<bool(control::DrivePermit)>(name, [](control::DrivePermit) { return true; });
  }
  joint.write(names.command, 0.0);
  joint.write("PositionSensor", 1.0);
  ASSERT_TRUE(joint.start()) << joint.reason();
  const auto cycle = [&](double position) {
    joint.run_cycles();
    joint.raise("Sample");
    joint.write("PositionSensor", position);
    joint.write(names.command, holding);
    joint.raise("Act");
  };
  int armed = 0;
  expect_realtime_on_bench("CommandOutput", [&] {
    cycle(1.0);
    joint.raise("Arm");
    for (int k = 0; k < 2000 && !joint.output<bool>("Armed"); ++k) cycle(1.0);
    armed += joint.output<bool>("Armed") ? 1 : 0;
    cycle(1.001);
    joint.raise("Disarm");
    cycle(1.0);
  });
  EXPECT_EQ(armed, 100);
  expect_realtime_on_bench("Joint", [&] { cycle(2.0); });
  EXPECT_EQ(joint.state(), component::State::kException);
}

TEST(RealtimeJoints, Torque) { expect_joint<JointCommand::kTorque>(2.0); }
TEST(RealtimeJoints, Velocity) { expect_joint<JointCommand::kVelocity>(0.0); }
TEST(RealtimeJoints, Position) { expect_joint<JointCommand::kPosition>(1.0); }

void expect_controller(const char* name, testing::Harness& controller) {
  controller.set("joints", 2);
  ASSERT_TRUE(controller.start()) << controller.reason();
  controller.write("reference", Vector(6, 1.0));
  controller.raise("Sample");
  controller.write("sensor", Vector(4, 0.5));
  expect_realtime_on_bench(name, [&] {
    controller.write("reference", Vector(6, 1.0));
    controller.raise("Sample");
    controller.write("sensor", Vector(4, 0.5));
  });
  EXPECT_EQ(controller.writes("act"), 101u);
}

TEST(RealtimeControllers, OfPositions) {
  testing::Harness controller(std::make_unique<ControllerNPosition>("Controller"));
  expect_controller("ControllerNPosition", controller);
  EXPECT_EQ(controller.output<Vector>("act"), Vector(2, 1.0));
}

TEST(RealtimeControllers, OfVelocities) {
  testing::Harness controller(std::make_unique<ControllerNVelocity>("Controller"));
  controller.set("Kp", Vector{4.0});
  expect_controller("ControllerNVelocity", controller);
  EXPECT_EQ(controller.output<Vector>("act"), Vector(2, 1.0 + 4.0 * 0.5));
}

}  // namespace
}  // namespace armature::controllers
