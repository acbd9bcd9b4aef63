// SPDX-License-Identifier: Apache-2.0
// What else the arm takes and tells, by its deployments: added torques, velocities of a reference,
// samples by a port, torques above their limits; temperatures and currents, the tool's pose.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/control/dynamics/forward_kinematics.hpp"
#include "armature/controllers/forward_kinematics/pose.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

const Vector kTarget{0.5, -1.5, 0.3, 2.5, 0.2, -0.2, 0.3};

/// The largest error of joint 1 to 4 in a motion of 3 s [rad], armed and settled before.
double largest_error(Arm& arm) {
  arm.start_armed();
  arm.run_for(1500ms);
  EXPECT_EQ(arm.move_to(kTarget, 3.0), "");
  double most = 0.0;
  for (int cycle = 0; cycle < 1750; ++cycle) {
    arm.cycle();
    const Vector desired = arm.desired(), now = arm.positions();
    for (std::size_t i = 0; i < 4; ++i) most = std::max(most, std::abs(desired[i] - now[i]));
  }
  EXPECT_TRUE(arm.armed()) << arm.log;
  return most;
}

void write(Arm& arm, const char* component, std::string_view port, const Vector& value) {
  component::Component& writer = *arm.application().find(component);
  for (component::OutputPortBase* output : component::interface_of(writer).outputs) {
    if (output->name() != port) continue;
    ASSERT_TRUE(arm.application().run_in_thread_of(writer, [&] { output->write_from(&value); }));
    return;
  }
  FAIL() << component << " has no output " << port;
}

std::string said(const std::string& file, std::vector<std::string> overrides = {}) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = std::move(overrides);
  return deploy::load_deployment(std::string(WAM "/deployments/") + file, options)
      .diagnostics.to_text();
}

// ---- Torques

TEST(WamAddedTorques, OfAModelAreAddedToThoseOfThePidsAndMakeItFollowBetter) {
  Arm pids("npid7.yaml");
  Arm with_model("npid_feed_forward7.yaml");
  const double alone = largest_error(pids);
  const double together = largest_error(with_model);
  EXPECT_LT(alone, 0.02);
  EXPECT_LT(together, 0.9 * alone) << "friction and rotors are left to the PIDs";
}

TEST(WamAddedTorques, UnarmedAreNotPassed) {
  Arm arm("npid_feed_forward7.yaml");
  arm.start_active();
  const Vector begin = arm.positions();
  for (int cycle = 0; cycle < 500; ++cycle) {
    write(arm, "Model", "Out", Vector(7, 10.0));
    arm.cycle();
  }
  EXPECT_LT(largest_apart(arm.positions(), begin), 0.005);
}

TEST(WamAddedTorques, ThatAreTooOldCountAsNone) {
  Arm arm("npid_feed_forward7.yaml");
  arm.start_armed();
  arm.run_for(2s);
  ASSERT_TRUE(arm.application().stop_component("Model"));
  write(arm, "Model", "Out", Vector{3.0, 0, 0, 0, 0, 0, 0});
  arm.run_for(6ms);
  EXPECT_GT(arm.hardware().torque_path().moving_torques()[0], 1.5) << "they count at first";
  arm.run_for(2s);
  EXPECT_LT(std::abs(arm.hardware().torque_path().moving_torques()[0]), 1.0);
  EXPECT_TRUE(arm.armed());
}

TEST(WamAddedTorques, OfAModelThatHoldsTheWeightTooAreRefused) {
  EXPECT_THAT(
      said("npid_feed_forward7.yaml", {"Model.gravity=[0, 0, -9.805]"}),
      AllOf(HasSubstr("'Model': joint 1 of WAM"), HasSubstr("its weight would be driven twice")));
}

/// The controller's place is the test's.
class WamOverLimit : public ::testing::Test {
 protected:
  explicit WamOverLimit() : arm("npid7.yaml", {"WAM.over_limit=refuse_all"}) {
    arm.start_armed();
    arm.run_for(1500ms);
    arm.log.clear();
  }
  void drive(const Vector& torques, int cycles) {
    ASSERT_TRUE(arm.application().stop_component("Controller"));
    for (int cycle = 0; cycle < cycles; ++cycle) {
      write(arm, "Actuator", "Torque", torques);
      arm.cycle();
    }
  }
  Arm arm;
};

TEST_F(WamOverLimit, NoTorqueIsSentAndAfterThreeCyclesTheArmIsHeld) {
  const Vector begin = arm.positions();
  drive({1.0, 0.0, 0.0, 26.0, 0.0, 0.0, 0.0}, 10);  // 25 Nm are the most
  EXPECT_FALSE(arm.armed());
  EXPECT_EQ(arm.value<int>("WAM", "refused"), 3);
  EXPECT_THAT(arm.log, HasSubstr("disarmed, and holds the arm where it is: no torque is sent: that "
                                 "of joint 4 is 26 Nm, above its limit"));
  arm.run_for(1s);
  EXPECT_LT(largest_apart(arm.positions(), begin), 0.01);
}

TEST_F(WamOverLimit, TorquesBelowTheirLimitsAreSent) {
  drive(Vector(7, 0.0), 10);
  EXPECT_TRUE(arm.armed());
  EXPECT_EQ(arm.value<int>("WAM", "refused"), 0);
}

// ---- The arm's own controller

TEST(WamReference, WithVelocitiesItsOwnControllerFollowsAsWell) {
  Arm with_positions("controller_wam7.yaml");
  Arm with_velocities("controller_wam_velocities7.yaml");
  const double positions = largest_error(with_positions);
  const double velocities = largest_error(with_velocities);
  EXPECT_LT(velocities, 0.02);
  EXPECT_LT(velocities, 1.2 * positions);
}

/// Says where five joints are to be.
class FiveJoints final : public component::Component {
 public:
  using Component::Component;

 private:
  component::OutputPort<Vector> out_{this, "Out", "positions", "rad", component::fixed_size(5)};
};

TEST(WamReference, OfAnotherSizeIsRefusedBeforeTheStart) {
  EXPECT_EQ(said("controller_wam_velocities7.yaml"), "");
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.models = [](component::Registry& models) {
    models.add<FiveJoints>("FiveJoints", "an arm with five joints");
  };
  const auto deployment = deploy::parse_deployment(
      "include: controller_wam7.yaml\ncomponents:\n  Five: {model: FiveJoints}\nconnections:\n"
      "  - {from: Controller.posRef, to: WAM.posRefPort, remove: true}\n"
      "  - Five.Out -> WAM.posRefPort\n",
      WAM "/deployments/five.yaml", options);
  EXPECT_THAT(deployment.diagnostics.to_text(),
              HasSubstr("posRefPort gets 5 numbers from 'Five.Out', expected 7 "
                        "positions, or 14 with velocities"));
}

// ---- Samples

TEST(WamSamplePort, BeginsTheSamplesOfSensorControllerAndActuator) {
  Arm by_event("npid7.yaml");
  Arm by_port("sample_port7.yaml");
  const double events = largest_error(by_event);
  EXPECT_EQ(largest_error(by_port), events) << "the same to the last bit";
  EXPECT_EQ(by_port.positions(), by_event.positions());
}

// ---- What it tells

TEST(WamPucks, TheirTemperaturesAndCurrentsAreOnPorts) {
  Arm arm("npid7.yaml");
  arm.start_active();
  for (std::size_t i = 0; i < 7; ++i) {
    arm.emulator().puck(i).set_temperatures(40 + static_cast<int>(i), 50 + static_cast<int>(i));
  }
  arm.run_for(2200ms);  // two rounds of all three
  const auto pucks = arm.value<Vector>("WAM", "puckTemperaturePort");
  const auto motors = arm.value<Vector>("WAM", "motorTemperaturePort");
  const auto currents = arm.value<Vector>("WAM", "motorCurrentPort");
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_DOUBLE_EQ(pucks[i], 313.15 + static_cast<double>(i));
    EXPECT_DOUBLE_EQ(motors[i], 323.15 + static_cast<double>(i));
    EXPECT_NEAR(currents[i], arm.emulator().puck(i).torque(), 200.0);
  }
  EXPECT_GT(std::abs(currents[1]), 100.0) << "it holds its weight";
  EXPECT_EQ(arm.value<int>("WAM", "unanswered_puck_questions"), 0);
  EXPECT_EQ(arm.value<int>("WAM", "lost_answers"), 0);
}

TEST(WamTool, ItsPoseIsOnAPort) {
  Arm arm("tool7.yaml");
  arm.start_active();
  const auto pose = arm.value<controllers::Pose>("Tool", "pose");
  base::Diagnostics diagnostics;
  auto kinematics =
      control::ForwardKinematics::load(WAM "/wam7.urdf", {.tip_link = "tool"}, diagnostics);
  ASSERT_TRUE(kinematics) << diagnostics.to_text();
  control::Pose expected;
  ASSERT_TRUE(kinematics->step(arm.positions(), expected));
  EXPECT_NEAR(pose.position.x, expected.position[0], 1e-3);
  EXPECT_NEAR(pose.position.y, expected.position[1], 1e-3);
  EXPECT_NEAR(pose.position.z, expected.position[2], 1e-3);
  const auto& q = pose.orientation;
  EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-12);
}

}  // namespace
}  // namespace armature::wam
