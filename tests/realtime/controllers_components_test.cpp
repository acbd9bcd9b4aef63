// SPDX-License-Identifier: Apache-2.0
// The component library `robot`: every hook and handler of its models.
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/component/host.hpp"
#include "armature/controllers/actuator_demux/actuator_demux.hpp"
#include "armature/controllers/arming/arming.hpp"
#include "armature/controllers/axes_generator/axes_generator.hpp"
#include "armature/controllers/axes_generator/axes_generator_online.hpp"
#include "armature/controllers/base/reason_text.hpp"
#include "armature/controllers/bridge/bridge.hpp"
#include "armature/controllers/bridge_ref/bridge_ref.hpp"
#include "armature/controllers/computed_torque/controller_computed_torque.hpp"
#include "armature/controllers/controller_npid/controller_npid.hpp"
#include "armature/controllers/controller_npid_ff/controller_npid_ff.hpp"
#include "armature/controllers/forward_kinematics/forward_kinematics.hpp"
#include "armature/controllers/gravity_pd/controller_gravity_pd.hpp"
#include "armature/controllers/joint/joint.hpp"
#include "armature/controllers/model/model.hpp"
#include "armature/controllers/pid/pid.hpp"
#include "armature/controllers/sampler/sampler.hpp"
#include "armature/controllers/sensor_mux/sensor_mux.hpp"
#include "armature/controllers/velocity_pid/velocity_pid.hpp"
#include "armature/testing/harness.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::controllers {
namespace {

using Vector = std::vector<double>;

void start(testing::Harness& bench) { ASSERT_TRUE(bench.start()) << bench.reason(); }

TEST(RealtimeComponents, Sampler) {
  testing::Harness sampler(std::make_unique<Sampler>("Sampler"));
  start(sampler);
  const auto& samples = sampler.record<>("Sample");
  expect_realtime_on_bench("Sampler", [&] {
    sampler.run_cycles();
    EXPECT_TRUE(sampler.call("trigger"));
  });
  EXPECT_EQ(samples.size(), 200u);
}

/// With a joint that is silent in every other round.
TEST(RealtimeComponents, SensorNMux) {
  testing::Harness sensor(std::make_unique<SensorNMux>("Sensor"));
  sensor.set("joints", 2);
  start(sensor);
  int round = 0;
  expect_realtime_on_bench("SensorNMux", [&] {
    sensor.raise("Sample");
    for (const char* port : {"Position1", "Displacement1"}) sensor.write(port, 1.0);
    if (++round % 2 == 0) return;
    for (const char* port : {"Position2", "Displacement2"}) sensor.write(port, 1.0);
  });
  EXPECT_EQ(sensor.get<int>("incomplete_rounds"), 49);
  EXPECT_EQ(sensor.state(), component::State::kRunning);
}

/// The handling of those who do not answer, to its end: the fault.
TEST(RealtimeComponents, MissingAnswers) {
  testing::Harness sensor(std::make_unique<SensorNMux>("Sensor"));
  sensor.set("joints", 2);
  start(sensor);
  expect_realtime_on_bench("MissingAnswers::note", [&] { sensor.raise("Sample"); });
  expect_realtime_on_bench("MissingAnswers::give_up", [&] { sensor.raise("Sample"); });
  EXPECT_EQ(sensor.state(), component::State::kException);
}

TEST(RealtimeComponents, ActuatorNDemux) {
  testing::Harness actuator(std::make_unique<ActuatorNDemux>("Actuator"));
  actuator.set("joints", 7);
  start(actuator);
  const auto& acts = actuator.record<>("Act");
  const Vector signals(7, 1.0);
  expect_realtime_on_bench("ActuatorNDemux", [&] {
    actuator.raise("Sample");
    actuator.write("act", signals);
  });
  EXPECT_EQ(acts.size(), 100u);
  actuator.write("act", Vector(7, NAN));
  expect_realtime_on_bench("ActuatorNDemux", [&] { actuator.write("act", signals); });
  EXPECT_EQ(actuator.state(), component::State::kException);
}

TEST(RealtimeComponents, Pid) {
  testing::Harness pid(std::make_unique<Pid>("PID"));
  pid.set("UMin", -1.0);
  pid.set("UMax", 1.0);
  pid.set("Ki", 1.0);
  start(pid);
  double gain = 0.0;
  expect_realtime_on_bench("Pid", [&] {
    pid.set("Kp", gain += 0.1);
    pid.write("Ref", 1.0);
    pid.write("Sen", 0.0);
    EXPECT_TRUE(pid.call("reset"));
  });
  EXPECT_EQ(pid.writes("Out"), 100u);
}

TEST(RealtimeComponents, VelocityPid) {
  testing::Harness pid(std::make_unique<VelocityPid>("PID"));
  pid.set("UMin", -1.0);
  pid.set("UMax", 1.0);
  pid.set("Ki", 0.1);
  pid.set("Period", 0.01);
  start(pid);
  expect_realtime_on_bench("VelocityPid", [&] {
    pid.write("Ref", 1.0);
    pid.write("Sen", 0.0);
    pid.raise("Arm");
  });
  EXPECT_EQ(pid.writes("Out"), 100u);
}

void write_reference_and_sensor(testing::Harness& controller) {
  controller.write("reference", Vector(6, 1.0));
  controller.raise("Sample");
  controller.write("sensor", Vector(4, 0.5));
}

TEST(RealtimeComponents, ControllerNPID) {
  testing::Harness controller(std::make_unique<ControllerNPID>("Controller"));
  controller.set("joints", 2);
  start(controller);
  int round = 0;
  expect_realtime_on_bench("ControllerNPID", [&] {
    write_reference_and_sensor(controller);
    controller.write("Out1", 1.0);
    if (++round % 2 == 1) controller.write("Out2", 1.0);
  });
  EXPECT_EQ(controller.get<int>("incomplete_rounds"), 49);
  EXPECT_EQ(controller.writes("act"), 50u);
}

TEST(RealtimeComponents, ControllerThatBrakesForWantOfAReference) {
  testing::Harness controller(std::make_unique<ControllerNPID>("Controller"));
  controller.set("joints", 2);
  controller.set("MaxAcceleration", Vector{1.0});
  controller.set("Period", 0.01);
  start(controller);
  write_reference_and_sensor(controller);
  const auto sample = [&] {
    controller.raise("Sample");
    controller.write("sensor", Vector(4, 0.1));
    controller.write("Out1", 1.0);
    controller.write("Out2", 1.0);
  };
  for (int i = 0; i < 20; ++i) {
    controller.advance(std::chrono::milliseconds(10));
    sample();
  }
  expect_realtime_on_bench("ControllerNPID", sample);
  EXPECT_EQ(controller.get<int>("brakings"), 1);
}

TEST(RealtimeComponents, ControllerNPIDFF) {
  testing::Harness controller(std::make_unique<ControllerNPIDFF>("Controller"));
  controller.set("joints", 2);
  for (const char* name : {"motor_resistance", "motor_torque_constant", "motor_gear_ratio"}) {
    controller.set(name, "[1.0]");
  }
  start(controller);
  expect_realtime_on_bench("ControllerNPIDFF", [&] {
    write_reference_and_sensor(controller);
    controller.write("Out_model", Vector(2, 0.1));
    for (const char* port : {"Out1", "Out2"}) controller.write(port, 1.0);
  });
  EXPECT_EQ(controller.writes("act"), 100u);
}

TEST(RealtimeComponents, ControllerComputedTorque) {
  testing::Harness controller(std::make_unique<ControllerComputedTorque>("Controller"));
  controller.set("joints", 2);
  controller.set("Period", 0.001);
  controller.set("robot_description", std::string_view(TESTDATA "/pan_tilt.urdf"));
  start(controller);
  expect_realtime_on_bench("ControllerComputedTorque",
                           [&] { write_reference_and_sensor(controller); });
  EXPECT_EQ(controller.writes("act"), 100u);
  controller.write("reference", Vector(6, NAN));
  expect_realtime_on_bench("ControllerComputedTorque", [&] {
    controller.raise("Sample");
    controller.write("sensor", Vector(4, 0.1));
  });
  EXPECT_EQ(controller.state(), component::State::kException);
}

TEST(RealtimeComponents, ControllerGravityPD) {
  testing::Harness controller(std::make_unique<ControllerGravityPD>("Controller"));
  controller.set("joints", 2);
  controller.set("Period", 0.001);
  controller.set("robot_description", std::string_view(TESTDATA "/pan_tilt.urdf"));
  controller.set("Kp", "[1]");
  controller.set("Kd", "[1]");
  start(controller);
  expect_realtime_on_bench("ControllerGravityPD", [&] { write_reference_and_sensor(controller); });
  EXPECT_EQ(controller.writes("act"), 100u);
}

TEST(RealtimeComponents, Model) {
  testing::Harness model(std::make_unique<Model>("Model"));
  model.set("joints", 2);
  model.set("robot_description", std::string_view(TESTDATA "/pan_tilt.urdf"));
  start(model);
  expect_realtime_on_bench("Model", [&] { model.write("In", Vector(6, 0.1)); });
  EXPECT_EQ(model.writes("Out"), 100u);
  expect_realtime_on_bench("Model", [&] { model.write("In", Vector(6, NAN)); });
  EXPECT_EQ(model.state(), component::State::kException);
}

TEST(RealtimeComponents, ForwardKinematics) {
  testing::Harness tool(std::make_unique<ForwardKinematics>("Tool"));
  tool.set("joints", 2);
  tool.set("robot_description", std::string_view(TESTDATA "/pan_tilt.urdf"));
  start(tool);
  expect_realtime_on_bench("ForwardKinematics",
                           [&] { tool.write("nAxesSensorPosition", Vector(2, 0.1)); });
  EXPECT_EQ(tool.writes("pose"), 100u);
  expect_realtime_on_bench("ForwardKinematics",
                           [&] { tool.write("nAxesSensorPosition", Vector(2, NAN)); });
  EXPECT_EQ(tool.state(), component::State::kException);
}

/// Held, let go, driven, watched, disarmed while it turns and switched off, again and again.
TEST(RealtimeComponents, Joint) {
  testing::Harness joint(std::make_unique<Joint>("Joint1"));
  joint.set("PeerName", "Card");
  joint.set("Brake", true);
  joint.set("PositionMin", -1e6);
  joint.set("PositionMax", 1e6);
  joint.set("MaxVelocity", 10.0);
  joint.set("MaxAcceleration", 100.0);
  joint.set("MaxVoltage", 12.0);
  joint.set("Period", 0.001);
  for (const char* name : {"actuatorOff", "brakeApply", "sensorRead"}) {
    joint.serve<bool()>(name, [] { return true; });
  }
  for (const char* name : {"actuatorOn", "brakeRelease"}) {
    joint.serve<bool(control::DrivePermit)>(name, [](control::DrivePermit) { return true; });
  }
  joint.write("Voltage", 0.0);
  start(joint);
  int armed = 0;
  const auto cycle = [&joint](double displacement) {
    joint.run_cycles();
    joint.raise("Sample");
    joint.write("DisplacementSensor", displacement);
    joint.write("IndexSensor", true);
    joint.write("Voltage", 2.0);
    joint.raise("Act");
  };
  expect_realtime_on_bench("Joint", [&] {
    cycle(0.0);
    joint.raise("Arm");
    for (int k = 0; k < 2000 && !joint.output<bool>("Armed"); ++k) cycle(0.0);
    armed += joint.output<bool>("Armed") ? 1 : 0;
    joint.raise("Rest");
    cycle(0.0);
    joint.raise("Motion");
    cycle(0.001);
    joint.raise("Disarm");
    cycle(0.0);
  });
  EXPECT_EQ(armed, 100);
  joint.run_cycles();
  joint.raise("Sample");
  expect_realtime_on_bench("Joint", [&] {
    joint.run_cycles();
    joint.write("DisplacementSensor", 0.0);
    joint.raise("Arm");
    joint.write<double>("Voltage", NAN);
    joint.raise("Act");
  });
  EXPECT_EQ(joint.state(), component::State::kException);
}

TEST(RealtimeComponents, Arming) {
  testing::Harness arming(std::make_unique<Arming>("Arming"));
  arming.set("joints", 2);
  start(arming);
  const Vector position(2, 1.0);
  const Vector rest(2, 0.0);
  int done = 0;
  const auto say_armed = [&](bool is) {
    arming.write("Armed1", is);
    arming.write("Armed2", is);
  };
  arming.write("nAxesSensorPosition", position);
  expect_realtime_on_bench("Arming", [&] {
    say_armed(false);
    const component::CommandHandle command = arming.send("arm");
    arming.run_cycles();
    arming.write("nAxesDesiredPosition", position);
    arming.write("nAxesDesiredVelocity", rest);
    arming.run_cycles();
    say_armed(true);
    arming.run_cycles();
    done += command.stage() == component::CommandStage::kDone ? 1 : 0;
    EXPECT_TRUE(arming.call("stop"));
    EXPECT_TRUE(arming.call("disarm"));
  });
  EXPECT_EQ(done, 100);
}

TEST(RealtimeComponents, Bridge) {
  testing::Harness bridge(std::make_unique<Bridge>("Bridge"));
  bridge.set("joints", 2);
  start(bridge);
  const Vector desired(2, 1.0);
  expect_realtime_on_bench("Bridge", [&] {
    bridge.write("Position1", 1.0);
    bridge.write("Position2", 2.0);
    bridge.write("nAxesDesiredPosition", desired);
  });
  EXPECT_EQ(bridge.writes("nAxesSensorPosition"), 199u);
}

TEST(RealtimeComponents, BridgeRef) {
  testing::Harness bridge(std::make_unique<BridgeRef>("Bridge"));
  bridge.set("joints", 2);
  start(bridge);
  expect_realtime_on_bench("BridgeRef", [&] {
    bridge.write("sensor", Vector(4, 1.0));
    for (const char* part : {"Position", "Velocity", "Acceleration"}) {
      bridge.write("nAxesDesired" + std::string(part), Vector(2, 1.0));
    }
  });
  EXPECT_EQ(bridge.writes("reference"), 100u);
}

TEST(RealtimeComponents, AxesGeneratorPos) {
  testing::Harness generator(std::make_unique<AxesGeneratorPos>("Generator"));
  generator.set("num_axes", 2);
  for (const char* name : {"max_vel", "max_acc", "upper"}) generator.set(name, "[1.0]");
  generator.set("lower", "[-1.0]");
  start(generator);
  const Vector zero(2, 0.0);
  generator.write("nAxesSensorPosition", zero);
  int motions = 0;
  int jogs = 0;
  const auto rest = [&] {
    for (int i = 0; i < 10; ++i) {
      generator.write("nAxesSensorPosition", zero);
      generator.run_cycles(50);
    }
  };
  expect_realtime_on_bench("AxesGeneratorPos", [&] {
    generator.write("nAxesSensorPosition", zero);
    generator.run_cycles();
    auto motion = generator.send("moveTo", Vector(2, 0.5), 0.0);
    if (motion.stage() == component::CommandStage::kAccepted) ++motions;
    EXPECT_FALSE(generator.call("moveTo", Vector(3, 0.5), 0.0));
    EXPECT_FALSE(generator.call("moveTo", Vector(2, 5.0), 0.0));
    generator.run_cycles(3);
    motion.cancel();
    generator.run_cycles(20);
    EXPECT_TRUE(generator.call("resetPosition"));
    rest();
    auto jog = generator.send("jog", 1, 0.1);
    if (jog.stage() == component::CommandStage::kAccepted) ++jogs;
    EXPECT_TRUE(generator.call<bool>("keepJogging", 1, 0.1).value());
    EXPECT_FALSE(generator.call("jog", 3, 0.1));
    EXPECT_FALSE(generator.call("jog", 1, 5.0));
    generator.run_cycles(3);
    jog.cancel();
    rest();
  });
  EXPECT_EQ(motions, 100);
  EXPECT_EQ(jogs, 100);
}

TEST(RealtimeComponents, AxesGeneratorOnline) {
  testing::Harness generator(std::make_unique<AxesGeneratorOnline>("Generator"));
  generator.set("num_axes", 2);
  for (const char* name : {"max_vel", "max_acc", "upper"}) generator.set(name, "[1.0]");
  generator.set("lower", "[-1.0]");
  start(generator);
  const Vector zero(2, 0.0);
  const Vector half(2, 0.5);
  generator.write("nAxesSensorPosition", zero);
  int motions = 0;
  int follows = 0;
  expect_realtime_on_bench("AxesGeneratorOnline", [&] {
    generator.write("nAxesSensorPosition", zero);
    generator.run_cycles();
    auto motion = generator.send("moveTo", half, 0.0);
    if (motion.stage() == component::CommandStage::kAccepted) ++motions;
    EXPECT_FALSE(generator.call("moveTo", Vector(2, 5.0), 0.0));
    generator.run_cycles(3);
    EXPECT_TRUE(generator.call<bool>("changeTarget", zero).value());
    generator.run_cycles(3);
    motion.cancel();
    EXPECT_TRUE(generator.call("resetPosition"));
    generator.write("nAxesReferencePosition", half);
    auto follow = generator.send("follow");
    if (follow.stage() == component::CommandStage::kAccepted) ++follows;
    generator.run_cycles(5);
    follow.cancel();
    generator.run_cycles(5);
  });
  EXPECT_EQ(motions, 100);
  EXPECT_EQ(follows, 100);
}

TEST(RealtimeComponents, AxesGeneratorOnlineJogsAndKeepsALimitOfAPeer) {
  testing::Harness generator(std::make_unique<AxesGeneratorOnline>("Generator"));
  generator.set("num_axes", 2);
  for (const char* name : {"max_vel", "max_acc", "upper"}) generator.set(name, "[1.0]");
  generator.set("lower", "[-1.0]");
  generator.serve<double(const Vector&, const Vector&)>(
      "motionLimitUsed", [](const Vector&, const Vector& v) { return 4.0 * (v[0] + v[1]); });
  start(generator);
  const Vector zero(2, 0.0);
  const Vector half(2, 0.5);
  generator.write("nAxesSensorPosition", zero);
  int motions = 0;
  int jogs = 0;
  expect_realtime_on_bench("AxesGeneratorOnline", [&] {
    generator.write("nAxesSensorPosition", zero);
    generator.run_cycles();
    auto motion = generator.send("moveTo", half, 0.0);
    if (motion.stage() == component::CommandStage::kAccepted) ++motions;
    generator.run_cycles(3);
    motion.cancel();
    EXPECT_TRUE(generator.call("resetPosition"));
    generator.run_cycles(3);
    auto jog = generator.send("jog", 1, 0.1);
    if (jog.stage() == component::CommandStage::kAccepted) ++jogs;
    EXPECT_TRUE(generator.call<bool>("keepJogging", 1, 0.1).value());
    generator.run_cycles(3);
    jog.cancel();
    EXPECT_TRUE(generator.call("resetPosition"));
  });
  EXPECT_EQ(motions, 100);
  EXPECT_EQ(jogs, 100);
}

template <typename Model>
void expect_realtime_restart(const char* model,
                             const std::vector<std::pair<const char*, const char*>>& properties) {
  testing::Harness bench(std::make_unique<Model>(model));
  for (const auto& [name, value] : properties) bench.set(name, value);
  start(bench);
  testing::RealtimeGuard guard;
  component::Outcome restarted = component::accepted();
  guard.watch([&] {
    component::Host::stop(bench.component());
    restarted = component::Host::start(bench.component());
  });
  EXPECT_TRUE(restarted) << bench.reason();
  EXPECT_EQ(guard.violations(), 0u) << model << ": " << guard.report();
}

TEST(RealtimeComponents, AStartAllocatesNothingIfNoPropertyChanged) {
  expect_realtime_restart<Sampler>("Sampler", {});
  expect_realtime_restart<SensorNMux>("SensorNMux", {{"joints", "7"}});
  expect_realtime_restart<ActuatorNDemux>("ActuatorNDemux", {{"joints", "7"}});
  expect_realtime_restart<Pid>("PID", {{"UMin", "-1"}, {"UMax", "1"}});
  expect_realtime_restart<ControllerNPID>("ControllerNPID", {{"joints", "7"}});
  expect_realtime_restart<ControllerNPIDFF>("ControllerNPIDFF", {{"joints", "7"},
                                                                 {"motor_resistance", "[1]"},
                                                                 {"motor_torque_constant", "[1]"},
                                                                 {"motor_gear_ratio", "[1]"}});
  expect_realtime_restart<ControllerComputedTorque>(
      "ControllerComputedTorque",
      {{"joints", "2"}, {"Period", "0.001"}, {"robot_description", TESTDATA "/pan_tilt.urdf"}});
  expect_realtime_restart<ControllerGravityPD>("ControllerGravityPD",
                                               {{"joints", "2"},
                                                {"Period", "0.001"},
                                                {"robot_description", TESTDATA "/pan_tilt.urdf"},
                                                {"Kp", "[1]"},
                                                {"Kd", "[1]"}});
  expect_realtime_restart<Model>(
      "Model", {{"joints", "2"}, {"robot_description", TESTDATA "/pan_tilt.urdf"}});
  expect_realtime_restart<BridgeRef>("BridgeRef", {{"joints", "7"}});
  expect_realtime_restart<AxesGeneratorOnline>("nAxesGeneratorOnline", {{"num_axes", "7"},
                                                                        {"max_vel", "[1]"},
                                                                        {"max_acc", "[1]"},
                                                                        {"lower", "[-1]"},
                                                                        {"upper", "[1]"}});
  expect_realtime_restart<AxesGeneratorPos>("nAxesGeneratorPos", {{"num_axes", "7"},
                                                                  {"max_vel", "[1]"},
                                                                  {"max_acc", "[1]"},
                                                                  {"lower", "[-1]"},
                                                                  {"upper", "[1]"}});
}

TEST(RealtimeFunctions, AppendNumber) {
  component::Reason reason;
  expect_realtime("controllers::append_number", [&] { append_number(reason, 0.5); });
  EXPECT_TRUE(reason.view().starts_with("0.50.5"));
}

class Owner final : public component::Component {
 public:
  using Component::Component;
  MissingAnswers missing{this};
};

TEST(RealtimeFunctions, MissingAnswers) {
  Owner owner("owner");
  owner.missing.resize(2);
  expect_realtime("MissingAnswers::reset", [&] { owner.missing.reset(); });
  EXPECT_EQ(owner.missing.names(), "");
}

}  // namespace
}  // namespace armature::controllers
