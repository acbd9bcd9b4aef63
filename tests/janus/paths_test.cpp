// SPDX-License-Identifier: Apache-2.0
// The head has two joints: its cameras cannot be led on a path of poses.
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"

namespace armature::janus {
namespace {

TEST(PathPlanner, AHeadWithTwoJointsIsRefusedWithAClearText) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  auto deployment = deploy::parse_deployment(R"(
include: pid.yaml
components:
  Generator: {override: true, model: nAxesGeneratorTaught}
  Planner:
    model: PathPlanner
    activity: {periodic: 10 ms, scheduler: other}
    peers: [Generator]
    properties: {joints: 2, robot_description: "${description}"}
connections:
  - Generator.nAxesDesiredPosition -> Planner.nAxesDesiredPosition
  - Generator.nAxesDesiredVelocity -> Planner.nAxesDesiredVelocity
)",
                                             JANUS "/deployments/paths.yaml", options);
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  EXPECT_THAT(application.start().to_text(),
              ::testing::HasSubstr("the robot has 2 joints, and a tool that is to be anywhere in "
                                   "any orientation needs six: move its joints"));
  EXPECT_FALSE(application.running());
}

}  // namespace
}  // namespace armature::janus
