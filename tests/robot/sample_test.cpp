// SPDX-License-Identifier: Apache-2.0
// Each arrangement that ships, with a Sampler that does not fire for a part of it: the Sample
// enables controller and actuator (paper 1, section 3), so nothing is computed and nothing moves.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::HasSubstr;

using Vector = std::vector<double>;

struct Arrangement {
  const char* name;
  const char* file;
  std::vector<std::string> controllers = {"Controller"};
};

void PrintTo(const Arrangement& arrangement, std::ostream* to) { *to << arrangement.name; }

const std::vector<Arrangement> kAll = {
    {"JanusPid", ROBOTS "/janus/deployments/pid.yaml"},
    {"JanusFeedForward", ROBOTS "/janus/deployments/pid_feed_forward.yaml"},
    {"JanusModes", ROBOTS "/janus/deployments/modes.yaml", {"Controller", "ControllerFF"}},
    {"JanusServed", ROBOTS "/janus/deployments/served.yaml"},
    {"Wam4Npid", ROBOTS "/wam/deployments/npid4.yaml"},
    {"Wam7Npid", ROBOTS "/wam/deployments/npid7.yaml"},
    {"Wam4ControllerWam", ROBOTS "/wam/deployments/controller_wam4.yaml"},
    {"Wam7ControllerWam", ROBOTS "/wam/deployments/controller_wam7.yaml"},
    {"Wam4ComputedTorque", ROBOTS "/wam/deployments/computed_torque4.yaml"},
    {"Wam7ComputedTorque", ROBOTS "/wam/deployments/computed_torque7.yaml"},
    {"Wam4GravityPd", ROBOTS "/wam/deployments/gravity_pd4.yaml"},
    {"Wam7GravityPd", ROBOTS "/wam/deployments/gravity_pd7.yaml"},
    {"Wam4Modes", ROBOTS "/wam/deployments/modes4.yaml", {"Controller", "ControllerCT"}},
    {"Wam7Modes", ROBOTS "/wam/deployments/modes7.yaml", {"Controller", "ControllerCT"}},
    {"OwnRobot", EXAMPLES "/07_own_robot/arm.yaml"},
    {"TorqueDrives", EXAMPLES "/11_drives/torque.yaml"},
    {"VelocityDrives", EXAMPLES "/11_drives/velocity.yaml"},
    {"PositionDrives", EXAMPLES "/11_drives/position.yaml"},
    {"Rail", EXAMPLES "/11_drives/rail.yaml"}};

/// An arrangement in which some components have another Sampler, which fires when it is told to.
class Robot {
 public:
  Robot(const Arrangement& arrangement, const std::string& others) {
    deploy::DeploymentOptions options;
    options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
    const std::string text = "application: unsampled\ninclude: " + std::string(arrangement.file) +
                             "\ncomponents:\n  Silent: {model: Sampler, activity: {triggered: "
                             "true, priority: 20}}\n" +
                             others;
    deployment_ = deploy::parse_deployment(text, "unsampled.yaml", options);
    if (!deployment_.ok()) return;
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    const auto started = application_->start();
    EXPECT_TRUE(started.ok()) << started.to_text();
  }

  std::string mistakes() const { return deployment_.diagnostics.to_text(); }
  exec::Application& application() { return *application_; }
  void run_for(base::Duration duration) { application_->run_for(duration); }
  template <typename T>
  T value(const std::string& component, const char* item) {
    const auto value = application_->value_of(component, item);
    EXPECT_TRUE(value) << value.error();
    return *static_cast<const T*>(value.value().data());
  }
  Vector positions() { return value<Vector>("BridgeRef", "nAxesSensorPosition"); }
  /// How often it has written `port`.
  std::uint64_t writes(const std::string& component, std::string_view port) {
    for (const auto* output : component::interface_of(*application_->find(component)).outputs) {
      if (output->name() == port) return output->current_sequence();
    }
    ADD_FAILURE() << component << " has no output " << port;
    return 0;
  }
  /// What the operator tries: arming, and a motion.
  void try_to_move() {
    static_cast<void>(application_->call("Arming", "arm", {}));
    for (int k = 0; k < 60; ++k) {
      run_for(100ms);
      Vector target = positions();
      for (double& each : target) each += 0.1;
      static_cast<void>(application_->call("Generator", "moveTo",
                                           {types::Value::of(target), types::Value::of(0.0)}));
    }
  }
  void expect_still(const Vector& before) {
    const Vector after = positions();
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-3) << i;
    EXPECT_FALSE(value<bool>("Arming", "armed"));
  }

 private:
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

class Unsampled : public ::testing::TestWithParam<Arrangement> {};

TEST_P(Unsampled, AControllerComputesNothingAndNothingMoves) {
  std::string others;
  for (const std::string& each : GetParam().controllers) {
    others += "  " + each + ": {override: true, peers: [Silent, Arming]}\n";
  }
  Robot robot(GetParam(), others);
  ASSERT_EQ(robot.mistakes().find("error"), std::string::npos) << robot.mistakes();
  robot.run_for(55ms);  // while all are in service: without `act` they stop after 100 ms
  static_cast<void>(robot.application().call("Arming", "arm", {}));
  robot.run_for(445ms);
  const Vector before = robot.positions();
  EXPECT_GT(robot.writes("Sensor", "sensor"), 4u) << "it is measured";
  robot.try_to_move();
  for (const std::string& each : GetParam().controllers) {
    EXPECT_EQ(robot.writes(each, "act"), 0u) << each;
  }
  EXPECT_GT(robot.value<int>("Controller", "sensor_without_sample"), 4);
  robot.expect_still(before);
}

TEST_P(Unsampled, AnActuatorDrivesNothing) {
  Robot robot(GetParam(), "  Actuator: {override: true, peers: [Silent]}\n");
  ASSERT_EQ(robot.mistakes().find("error"), std::string::npos) << robot.mistakes();
  robot.run_for(55ms);  // while all are in service: without `act` they stop after 100 ms
  static_cast<void>(robot.application().call("Arming", "arm", {}));
  robot.run_for(445ms);
  const Vector before = robot.positions();
  robot.try_to_move();
  EXPECT_GT(robot.writes("Controller", "act"), 0u);
  robot.expect_still(before);
}

TEST_P(Unsampled, AControllerWithoutASamplerIsRefusedAtCheck) {
  const Robot robot(GetParam(), "  Controller: {override: true, peers: [Arming]}\n");
  EXPECT_THAT(robot.mistakes(), HasSubstr("'Controller': nobody samples it"));
  EXPECT_THAT(robot.mistakes(), HasSubstr("add the Sampler to its peers"));
}

TEST(UnsampledOwnRobot, OneSampleIsOneComputation) {
  Robot robot(kAll.back(), "  Controller: {override: true, peers: [Silent, Arming]}\n");
  ASSERT_EQ(robot.mistakes().find("error"), std::string::npos) << robot.mistakes();
  robot.run_for(45ms);
  for (std::uint64_t samples = 1; samples <= 3; ++samples) {
    ASSERT_TRUE(robot.application().call("Silent", "trigger", {}));
    robot.run_for(30ms);
    EXPECT_EQ(robot.writes("Controller", "act"), samples);
  }
}

INSTANTIATE_TEST_SUITE_P(Arrangements, Unsampled, ::testing::ValuesIn(kAll),
                         [](const auto& arrangement) {
                           return std::string(arrangement.param.name);
                         });

}  // namespace
}  // namespace armature
