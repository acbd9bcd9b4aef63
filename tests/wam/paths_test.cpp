// SPDX-License-Identifier: Apache-2.0
// The arm's tool on lines, arcs and paths, planned by PathPlanner.
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/on_paths.hpp"

namespace armature::wam {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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
                 HasSubstr(" m along the path of 2.000 m, at x "));
  expect_refused("moveLinear",
                 {types::Value::of(numbers({beside(1e9, 0, 0)})), types::Value::of(0.0)},
                 HasSubstr("expected up to 100"));
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

TEST_F(WamOnPaths, APathBeginsOnlyWhereTheJointsRest) {
  const std::vector<types::Value> line{types::Value::of(numbers({beside(0, 0.1, 0)})),
                                       types::Value::of(0.0)};
  auto move = arm.application().begin(
      "Generator", "moveTo",
      {types::Value::of(Vector{0.4, -1.0, 0.3, 2.2, -0.5, 0.4, 0.5}), types::Value::of(3.0)});
  ASSERT_TRUE(move) << move.error();
  arm.run_for(1s);
  const auto moves = HasSubstr("the joints move, or brake: wait until they rest");
  EXPECT_THAT(run("Planner", "moveLinear", line), moves);
  EXPECT_EQ(move.value().stage(), CommandStage::kAccepted) << "and disturbs nothing";
  move.value().cancel();
  arm.run_for(20ms);
  EXPECT_EQ(move.value().stage(), CommandStage::kCancelled);
  EXPECT_THAT(run("Planner", "moveLinear", line), moves) << "it brakes";
  arm.run_for(2s);
  EXPECT_EQ(run("Planner", "moveLinear", line), "");
}

TEST_F(WamOnPaths, StoppingThePlannerEndsItsMotion) {
  auto begun = arm.application().begin(
      "Planner", "moveLinear",
      {types::Value::of(numbers({beside(0.05, 0.3, 0.1)})), types::Value::of(0.0)});
  ASSERT_TRUE(begun) << begun.error();
  arm.run_for(1s);
  ASSERT_TRUE(arm.application().stop_component("Planner"));
  arm.run_for(1s);
  const Vector rest = desired();
  EXPECT_EQ(arm.value<Vector>("Generator", "nAxesDesiredVelocity"), Vector(7, 0.0));
  arm.run_for(500ms);
  EXPECT_EQ(desired(), rest);
  ASSERT_TRUE(arm.application().start_component("Planner"));
  EXPECT_EQ(
      run("Planner", "moveLinear", {types::Value::of(numbers({begin_})), types::Value::of(0.0)}),
      "");
}

TEST_F(WamOnPaths, AnEstopEndsItAndNothingGoesOnAfterTheReset) {
  auto begun = arm.application().begin(
      "Planner", "moveLinear",
      {types::Value::of(numbers({beside(0.05, 0.3, 0.1)})), types::Value::of(0.0)});
  ASSERT_TRUE(begun) << begun.error();
  arm.run_for(1s);
  ASSERT_EQ(arm.call("WAM", "estop"), "");
  arm.run_for(200ms);
  EXPECT_EQ(arm.state("WAM"), component::State::kException);
  EXPECT_FALSE(arm.armed());
  EXPECT_EQ(begun.value().stage(), CommandStage::kFailed);
  EXPECT_TRUE(arm.pucks_are_idle()) << "the arm brakes";
  ASSERT_TRUE(arm.application().reset_component("WAM")) << arm.reason("WAM");
  ASSERT_TRUE(arm.application().clean_up_component("WAM"));
  ASSERT_TRUE(arm.application().start_component("WAM")) << arm.reason("WAM");
  for (const char* name :
       {"Sensor", "BridgeRef", "Reference", "Generator", "Controller", "PID1", "PID2", "PID3",
        "PID4", "PID5", "PID6", "PID7", "Actuator", "Arming", "Planner"}) {
    if (arm.state(name) != component::State::kStopped) continue;
    ASSERT_TRUE(arm.application().start_component(name)) << name;
  }
  arm.run_for(1s);
  ASSERT_EQ(arm.safety_state(), "ACTIVATED") << arm.waits_for();
  const Vector home = arm.positions();
  arm.run_for(2s);
  EXPECT_LT(largest_apart(arm.positions(), home), 0.003) << "nothing goes on by itself";
  arm.arm();
  arm.run_for(2s);
  EXPECT_LT(largest_apart(arm.positions(), home), 0.005) << "nor once it is armed";
}

/// Its Planner in another activity.
std::string mistakes_with(const std::string& activity) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  auto deployment = deploy::parse_deployment(
      "include: paths.yaml\ncomponents:\n  Planner: {override: true, "
      "activity: {" +
          activity + "}}\n",
      WAM "/demo/other.yaml", options);
  return deployment.diagnostics.to_text();
}

TEST(PathPlanner, PlansInNoThreadOfTheControl) {
  EXPECT_THAT(mistakes_with("periodic: 2 ms, priority: 40"),
              AllOf(HasSubstr("'Planner': it plans for tens of milliseconds"),
                    HasSubstr("scheduler: other")));
  EXPECT_THAT(mistakes_with("periodic: 10 ms, scheduler: deadline, budget: 1 ms"),
              HasSubstr("its thread is a real-time one"));
  EXPECT_THAT(mistakes_with("periodic: 40 ms, scheduler: other"), HasSubstr("at most 20 ms"));
  EXPECT_EQ(mistakes_with("periodic: 10 ms, scheduler: other"), "");
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
  - Generator.nAxesDesiredVelocity -> Planner.nAxesDesiredVelocity
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
