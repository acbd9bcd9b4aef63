// SPDX-License-Identifier: Apache-2.0
// What the deployments of robots let scripts do.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"

namespace armature {
namespace {

using ::testing::HasSubstr;

deploy::DeploymentOptions options_with(std::vector<std::string> overrides) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = std::move(overrides);
  return options;
}

deploy::Deployment load(const std::string& file, std::vector<std::string> overrides = {}) {
  return deploy::load_deployment(SOURCES "/robots/" + file, options_with(std::move(overrides)));
}

/// A file that includes that of a simulated robot.
deploy::Deployment including(const std::string& grants, std::vector<std::string> overrides) {
  return deploy::parse_deployment("include: npid.yaml\n" + grants,
                                  SOURCES "/robots/wam/demo/own.yaml",
                                  options_with(std::move(overrides)));
}

TEST(GrantsOf, FilesOfHardwareAreNone) {
  for (const char* file : {"wam/deployments/npid4.yaml", "wam/deployments/npid7.yaml",
                           "wam/deployments/modes7.yaml"}) {
    const deploy::Deployment deployment = load(file, {"bus=can0"});
    EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
    EXPECT_TRUE(deployment.document.script_grants.empty()) << file;
  }
  const deploy::Deployment head = load("janus/deployments/on_can.yaml");
  EXPECT_TRUE(head.ok()) << head.diagnostics.to_text();
  EXPECT_TRUE(head.document.script_grants.empty());
}

TEST(GrantsOf, ARealRobotAreRefusedUnlessTheFileSaysThatTheyAreMeant) {
  const deploy::Deployment careless = including("", {"bus=can0"});
  EXPECT_FALSE(careless.ok());
  EXPECT_THAT(careless.diagnostics.to_text(),
              HasSubstr("scripts are granted 'Arming.arm', but 'WAM' drives a real robot by can0"));
  const deploy::Deployment taken_back = including("grants: {script: []}\n", {"bus=can0"});
  EXPECT_TRUE(taken_back.ok()) << taken_back.diagnostics.to_text();
  EXPECT_TRUE(taken_back.options.grants.empty());
  const deploy::Deployment meant = including("grants: {on_hardware: true}\n", {"bus=can0"});
  EXPECT_TRUE(meant.ok()) << meant.diagnostics.to_text();
  EXPECT_EQ(meant.options.grants.size(), 1U);
}

TEST(GrantsOf, ASimulatedRobotAreAccepted) {
  for (const char* bus : {"bus=emulator", "bus=virtual:/tmp/wam.bus"}) {
    const deploy::Deployment deployment = including("", {bus});
    EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
    EXPECT_EQ(deployment.options.grants.size(), 1U);
  }
}

}  // namespace
}  // namespace armature
