// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/deployment_root.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::bundle::internal {
namespace {

using ::testing::HasSubstr;

DeploymentFiles files(std::initializer_list<std::string> paths) {
  DeploymentFiles files;
  for (const std::string& path : paths) files.files.emplace(path, base::Location{"a.yaml", 3, 1});
  return files;
}

TEST(DeploymentRoot, IsTheFolderOfASingleFile) {
  base::Diagnostics diagnostics;
  EXPECT_EQ(deployment_root(files({"/home/ann/arm/arm.yaml"}), diagnostics), "/home/ann/arm/");
}

TEST(DeploymentRoot, IsTheDeepestFolderThatHasAll) {
  base::Diagnostics diagnostics;
  EXPECT_EQ(deployment_root(files({"/home/ann/arm/deployments/arm.yaml", "/home/ann/arm/arm.urdf"}),
                            diagnostics),
            "/home/ann/arm/");
  EXPECT_EQ(
      deployment_root(files({"/home/ann/arm2/a.yaml", "/home/ann/arm/arm.urdf"}), diagnostics),
      "/home/ann/");
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
}

TEST(DeploymentRoot, HasThePlaceOfAKeyThatStaysAtHome) {
  base::Diagnostics diagnostics;
  DeploymentFiles all = files({"/home/ann/arm/arm.yaml"});
  all.keys.insert("/home/ann/keys/arm.key");
  EXPECT_EQ(deployment_root(all, diagnostics), "/home/ann/");
}

TEST(DeploymentRoot, RefusesFilesOfTheSystem) {
  base::Diagnostics diagnostics;
  EXPECT_EQ(
      deployment_root(files({"/etc/armature/robot.policy", "/home/ann/arm.yaml"}), diagnostics),
      "");
  EXPECT_THAT(diagnostics.to_text(),
              HasSubstr("a.yaml:3:1: error: '/etc/armature/robot.policy' belongs to the system, "
                        "expected a file of the deployment (copy it beside the deployment"));
}

TEST(DeploymentRoot, RefusesFilesWithoutACommonFolder) {
  base::Diagnostics diagnostics;
  EXPECT_EQ(deployment_root(files({"/home/ann/arm.yaml", "/srv/arm.urdf"}), diagnostics), "");
  EXPECT_THAT(diagnostics.to_text(),
              HasSubstr("'/home/ann/arm.yaml' and '/srv/arm.urdf' have no folder in common"));
}

}  // namespace
}  // namespace armature::bundle::internal
