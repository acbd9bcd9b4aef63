// SPDX-License-Identifier: Apache-2.0
// Deployments that do not fit their robot are refused before anything moves, with what to mend.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using ::testing::HasSubstr;

/// A description of the head whose tilt joint was forgotten to be one.
std::string description_with_one_joint() {
  std::ifstream file(JANUS "/janus.urdf");
  std::stringstream text;
  text << file.rdbuf();
  std::string description = text.str();
  const std::string tilt = "name=\"joint2\" type=\"revolute\"";
  const std::size_t at = description.find(tilt);
  if (at == std::string::npos) throw std::logic_error("janus.urdf has no " + tilt);
  description.replace(at, tilt.size(), "name=\"joint2\" type=\"fixed\"");
  const std::string path = ::testing::TempDir() + "one_joint.urdf";
  std::ofstream(path) << description;
  return path;
}

/// What a start of the deployment says, which fails.
std::string refusal(const std::string& file, const std::vector<std::string>& overrides) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = overrides;
  deploy::Deployment deployment = deploy::load_deployment(file, options);
  if (!deployment.ok()) return deployment.diagnostics.to_text();
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  const base::Diagnostics started = application.start();
  EXPECT_FALSE(started.ok());
  EXPECT_FALSE(application.running());
  return started.to_text();
}

TEST(Mismatch, APlantWithOneJointTooFewIsRefused) {
  const std::string path = description_with_one_joint();
  EXPECT_THAT(refusal(JANUS "/deployments/pid.yaml", {"description=" + path}),
              HasSubstr(path + " moves 1 joints, expected joints = 2"));
}

TEST(Mismatch, AModelWithOneJointTooFewIsRefused) {
  const std::string path = description_with_one_joint();
  EXPECT_THAT(refusal(JANUS "/deployments/pid_feed_forward.yaml",
                      {"description=" JANUS "/janus.urdf", "Model.robot_description=" + path}),
              HasSubstr(path + " moves 1 joints"));
}

TEST(Mismatch, ThreeJointsOnAHeadWithTwoAreRefused) {
  EXPECT_THAT(refusal(TESTS "/three_joints.yaml", {"description=" JANUS "/janus.urdf"}),
              HasSubstr("cards has 3, expected 1 or 2"));
}

}  // namespace
}  // namespace armature::janus
