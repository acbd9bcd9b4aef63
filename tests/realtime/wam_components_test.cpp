// SPDX-License-Identifier: Apache-2.0
// The component library `wam`: every hook and handler of its models, over the emulated arm.
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "armature/component/host.hpp"
#include "armature/testing/harness.hpp"
#include "robots/wam/actuator_wam.hpp"
#include "robots/wam/sensor_wam.hpp"
#include "robots/wam/wam_hardware.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using Vector = std::vector<double>;

/// An active arm on the bench.
class RealtimeWam : public ::testing::Test {
 protected:
  RealtimeWam() : bench(std::make_unique<WamHardware>("WAM"), 2ms) {
    component::Host::context(bench.component()).simulated = true;
    bench.set("joints", 7);
    bench.set("Period", 0.002);
    bench.set("robot_description", WAM "/wam7.urdf");
    bench.set("PositionMin", Vector{-4.8});
    bench.set("PositionMax", Vector{3.2});
    for (const char* limit : {"MaxVelocity", "MaxAcceleration", "MaxTorqueGrowth"}) {
      bench.set(limit, Vector{5.0});
    }
    for (const char* most : {"MaxControlTorque", "MaxTorque"}) bench.set(most, Vector{50.0});
    EXPECT_TRUE(bench.start()) << bench.reason();
  }
  void cycle() {
    bench.advance(2ms);
    bench.raise("Sample");
    static_cast<void>(bench.call<bool>("getJointSensorsOperation"));  // not served after a fault
    bench.write("posRefPort", wam7().home);
    bench.write("torRefPort", Vector(7, 0.1));
  }
  void activate() {
    for (int i = 0; i < 100; ++i) cycle();
    ASSERT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kHolding);
  }
  WamHardware& hardware() { return static_cast<WamHardware&>(bench.component()); }
  template <typename Code>
  void expect_realtime_on_bench(const char* what, int times, Code&& code) {
    const testing::RealtimeGuard guard;
    for (int i = 0; i < times; ++i) code();
    EXPECT_EQ(guard.violations(), 0u) << what << ": " << guard.report();
  }

  testing::Harness bench;
};

TEST_F(RealtimeWam, IdleAndOnItsWayToActive) {
  expect_realtime_on_bench("WamHardware, idle", 100, [this] { cycle(); });
  EXPECT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kHolding);
}

TEST_F(RealtimeWam, HoldingArmedAndDisarmed) {
  activate();
  expect_realtime_on_bench("WamHardware, holding", 100, [this] { cycle(); });
  expect_realtime_on_bench("WamHardware::on_arm", 1, [this] { bench.raise("Arm"); });
  expect_realtime_on_bench("WamHardware, armed", 100, [this] { cycle(); });
  EXPECT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kDriven);
  expect_realtime_on_bench("WamHardware::on_disarm", 1, [this] { bench.raise("Disarm"); });
  EXPECT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kHolding);
}

TEST_F(RealtimeWam, ATorqueReferenceThatStaysAway) {
  activate();
  bench.raise("Arm");
  cycle();
  expect_realtime_on_bench("WamHardware without commands", 10, [this] {
    bench.advance(2ms);
    bench.raise("Sample");
  });
  EXPECT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kHolding);
}

TEST_F(RealtimeWam, IdledByTheOperator) {
  activate();
  hardware().emulated()->emulator().board().shift_idle();
  expect_realtime_on_bench("WamHardware, idled", 200, [this] { cycle(); });
  EXPECT_EQ(hardware().torque_path().mode(), TorquePath::Mode::kHolding) << "and active again";
}

TEST_F(RealtimeWam, TheWayToAFault) {
  activate();
  hardware().emulated()->emulator().puck(1).set_dead(true);
  expect_realtime_on_bench("WamHardware, a silent puck", 30, [this] { cycle(); });
  EXPECT_EQ(bench.state(), component::State::kException);
}

TEST(RealtimeComponents, SensorWam) {
  testing::Harness sensor(std::make_unique<SensorWam>("Sensor"));
  sensor.set("joints", 7);
  sensor.set("Period", 0.002);
  sensor.serve<bool()>("getJointSensorsOperation", [] { return true; });
  ASSERT_TRUE(sensor.start()) << sensor.reason();
  const Vector data(21, 0.5);
  const testing::RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) {
    sensor.raise("Sample");
    sensor.write("InputSensorPort", data);
  }
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_EQ(sensor.output<Vector>("sensor")[7], 0.5 * 0.002);
}

TEST(RealtimeComponents, ActuatorWam) {
  testing::Harness actuator(std::make_unique<ActuatorWam>("Actuator"));
  actuator.set("joints", 7);
  ASSERT_TRUE(actuator.start()) << actuator.reason();
  const Vector torques(7, 0.5);
  const testing::RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) {
    actuator.raise("Sample");
    actuator.write("act", torques);
  }
  actuator.write("act", Vector(7, 0.7));
  actuator.write("act", Vector(7, NAN));
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_EQ(actuator.output<Vector>("Torque")[0], 0.5)
      << "neither what no Sample enables nor what is no number is handed on";
  EXPECT_EQ(actuator.get<int>("act_without_sample"), 1);
  EXPECT_EQ(actuator.reason(), "the torque for joint 1 is nan, expected finite numbers");
}

}  // namespace
}  // namespace armature::wam
