// SPDX-License-Identifier: Apache-2.0
// The arm's tool on lines, arcs and paths, planned by PathPlanner.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/cartesian/inverse_kinematics.hpp"
#include "armature/control/cartesian/pose_path.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using control::Pose;
using control::PosePath;
using ::testing::AllOf;
using ::testing::HasSubstr;

class WamOnPaths : public ::testing::Test {
 protected:
  WamOnPaths() : arm("../demo/paths.yaml", {}) {
    base::Diagnostics diagnostics;
    kinematics_ = control::InverseKinematics::load(
        WAM "/wam7.urdf", {.base_link = {}, .tip_link = "tool"}, diagnostics);
  }
  void SetUp() override {
    arm.start_armed();
    ASSERT_EQ(
        run("Generator", "moveTo",
            {types::Value::of(Vector{0.2, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5}), types::Value::of(4.0)}),
        "");
    arm.run_for(500ms);
    begin_ = kinematics_->pose_at(desired());
  }
  Vector desired() { return arm.value<Vector>("Generator", "nAxesDesiredPosition"); }
  /// Where it began, and so much beside [m].
  Pose beside(double x, double y, double z) {
    control::PoseNumbers numbers = control::numbers_of(begin_);
    numbers[0] += x;
    numbers[1] += y;
    numbers[2] += z;
    return control::pose_of(numbers);
  }
  static Vector numbers(const std::vector<Pose>& poses) {
    Vector all;
    for (const Pose& pose : poses) {
      const control::PoseNumbers one = control::numbers_of(pose);
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  }
  /// @return why it was not done, or nothing
  std::string run(
      const char* component, const char* command, std::vector<types::Value> arguments,
      const std::function<void()>& each_cycle = [] {}) {
    auto begun = arm.application().begin(component, command, std::move(arguments));
    if (!begun) return begun.error();
    for (int i = 0; i < 30000 && !begun.value().ended(); ++i) {
      arm.cycle();
      each_cycle();
    }
    return begun.value().stage() == CommandStage::kDone ? "" : std::string(begun.value().reason());
  }
  /// Follows a path, and looks at the tool's reference and at the tool.
  void follow(const char* command, std::vector<types::Value> arguments, const PosePath& path) {
    double off = 0.0;
    double arm_off = 0.0;
    double fastest = 0.0;
    Pose last = kinematics_->pose_at(desired());
    const auto look = [&] {
      const Pose wanted = kinematics_->pose_at(desired());
      fastest = std::max(fastest, control::distance(wanted, last).way / 0.002);
      last = wanted;
      off = std::max(off, distance_from(path, wanted));
      arm_off = std::max(arm_off, distance_from(path, kinematics_->pose_at(measured())));
    };
    ASSERT_EQ(run("Planner", command, std::move(arguments), look), "") << arm.log;
    arm.run_for(500ms);
    EXPECT_LT(off, 0.0015) << "max_deviation, and a millimetre of what it is compared with";
    EXPECT_LT(arm_off, 0.02) << "the arm lags behind, mostly along the path";
    EXPECT_LT(fastest, 0.26) << "max_tool_velocity";
    EXPECT_LT(control::distance(kinematics_->pose_at(desired()), path.at(path.length())).way, 1e-3);
    EXPECT_LT(control::distance(kinematics_->pose_at(measured()), path.at(path.length())).way,
              5e-3);
    EXPECT_TRUE(arm.armed()) << arm.log;
  }
  static double distance_from(const PosePath& path, const Pose& pose) {
    double nearest = 1.0;
    const int steps = static_cast<int>(path.length() / 0.001);
    for (int i = 0; i <= steps; ++i) {
      nearest = std::min(nearest, control::distance(path.at(path.length() * i / steps), pose).way);
    }
    return nearest;
  }
  Vector measured() {
    Vector all = arm.value<Vector>("Sensor", "sensor");
    all.resize(7);
    return all;
  }
  void expect_refused(const char* command, std::vector<types::Value> arguments,
                      const ::testing::Matcher<std::string>& why) {
    const Vector before = desired();
    EXPECT_THAT(run("Planner", command, std::move(arguments)), why);
    arm.run_for(500ms);
    EXPECT_EQ(desired(), before) << "nothing moves";
  }

  Arm arm;
  std::optional<control::InverseKinematics> kinematics_;
  Pose begin_;
};

TEST_F(WamOnPaths, MovesItsToolOnALine) {
  const Pose to = beside(0.05, 0.2, 0.1);
  follow("moveLinear", {types::Value::of(numbers({to})), types::Value::of(0.0)},
         PosePath::line(begin_, to).value());
}

TEST_F(WamOnPaths, MovesItsToolOnAnArc) {
  const Pose via = beside(0, 0.08, 0.08);
  const Pose to = beside(0, 0.16, 0);
  follow("moveArc",
         {types::Value::of(Vector{via.position[0], via.position[1], via.position[2]}),
          types::Value::of(numbers({to})), types::Value::of(0.2)},
         PosePath::arc(begin_, via.position, to).value());
}

TEST_F(WamOnPaths, MovesItsToolOnASquareWithRoundedCorners) {
  const std::vector<Pose> poses{beside(0, 0.12, 0), beside(0, 0.12, 0.12), beside(0, 0, 0.12),
                                begin_};
  follow("movePath",
         {types::Value::of(numbers(poses)), types::Value::of(0.03), types::Value::of(0.0)},
         PosePath::through(begin_, poses, 0.03).value());
}

TEST_F(WamOnPaths, WhatCannotBeIsRefusedAndNothingMoves) {
  expect_refused("moveLinear",
                 {types::Value::of(numbers({beside(0, 0, 2)})), types::Value::of(0.0)},
                 HasSubstr(" m along the path of 2.000 m "));
  expect_refused("moveLinear", {types::Value::of(Vector{1, 2, 3}), types::Value::of(0.0)},
                 HasSubstr("found 3 numbers, expected six for each pose"));
  expect_refused("moveLinear",
                 {types::Value::of(numbers({beside(0, 0.1, 0)})), types::Value::of(3.0)},
                 HasSubstr("expected 0 to max_tool_velocity"));
  expect_refused("movePath",
                 {types::Value::of(numbers({beside(0, 0.1, 0), beside(0, 0.1, 0.1)})),
                  types::Value::of(0.0), types::Value::of(0.0)},
                 HasSubstr("expected one above 0"));
}

TEST_F(WamOnPaths, ADisarmedArmIsNotMoved) {
  ASSERT_TRUE(arm.application().call("Arming", "disarm", {}));
  arm.run_for(500ms);
  EXPECT_THAT(
      run("Planner", "moveLinear",
          {types::Value::of(numbers({kinematics_->pose_at(desired())})), types::Value::of(0.0)}),
      ::testing::Not(::testing::IsEmpty()));
  const Vector before = measured();
  EXPECT_THAT(run("Planner", "moveLinear",
                  {types::Value::of(numbers({beside(0, 0.1, 0)})), types::Value::of(0.0)}),
              HasSubstr("not armed"));
  arm.run_for(500ms);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(measured()[i], before[i], 0.02);
}

TEST_F(WamOnPaths, CancelledItBrakesOnThePath) {
  const Pose to = beside(0.05, 0.3, 0.1);
  const PosePath path = PosePath::line(begin_, to).value();
  auto begun = arm.application().begin("Planner", "moveLinear",
                                       {types::Value::of(numbers({to})), types::Value::of(0.0)});
  ASSERT_TRUE(begun) << begun.error();
  arm.run_for(1s);
  begun.value().cancel();
  arm.run_for(1s);
  EXPECT_EQ(begun.value().stage(), CommandStage::kCancelled);
  const Vector rest = desired();
  arm.run_for(500ms);
  EXPECT_EQ(desired(), rest);
  const Pose pose = kinematics_->pose_at(desired());
  EXPECT_LT(distance_from(path, pose), 0.0015);
  EXPECT_GT(control::distance(pose, begin_).way, 0.03);
  EXPECT_GT(control::distance(pose, to).way, 0.03);
  EXPECT_TRUE(arm.armed());
}

TEST(PathPlanner, AnArmWithFewerThanSixJointsIsRefused) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  auto deployment = deploy::parse_deployment(R"(
include: npid4.yaml
components:
  Generator: {override: true, model: nAxesGeneratorTaught, peers: [Arming, WAM]}
  Planner:
    model: PathPlanner
    activity: {periodic: 4 ms, scheduler: other}
    peers: [Generator]
    properties: {joints: 4, robot_description: "${description}", tip_link: tool}
connections:
  - Generator.nAxesDesiredPosition -> Planner.nAxesDesiredPosition
)",
                                             WAM "/deployments/paths4.yaml", options);
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  EXPECT_THAT(application.start().to_text(),
              AllOf(HasSubstr("'Planner' refuses"), HasSubstr("needs six: move its joints")));
}

}  // namespace
}  // namespace armature::wam
