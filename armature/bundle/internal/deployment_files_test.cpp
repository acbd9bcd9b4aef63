// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/deployment_files.hpp"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::bundle::internal {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class FilesTest : public ::testing::Test {
 protected:
  FilesTest() { fs::create_directories(folder_); }
  ~FilesTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    ASSERT_TRUE(platform::write_file(path(name), text));
  }

  /// Names of what `arm.yaml` refers to, from the folder of the test.
  std::vector<std::string> found(const std::string& script = {}) {
    all_ = find_files({path("arm.yaml"), {}, script.empty() ? "" : path(script)}, diagnostics_);
    std::vector<std::string> names;
    for (const auto& [file, where] : all_.files) {
      names.push_back(fs::path(file).lexically_relative(folder_).string());
    }
    return names;
  }

  const fs::path folder_ = fs::absolute(fs::path(::testing::TempDir())) / "deployment files";
  base::Diagnostics diagnostics_;
  DeploymentFiles all_;
};

TEST_F(FilesTest, AreTheDeploymentAndAllThatItIncludes) {
  write("arm.yaml", "application: arm\ninclude: [shared/control.yaml]\n");
  write("shared/control.yaml", "include: limits.yaml\n");
  write("shared/limits.yaml", "components: {}\n");
  EXPECT_THAT(found(), ElementsAre("arm.yaml", "shared/control.yaml", "shared/limits.yaml"));
  EXPECT_TRUE(diagnostics_.empty()) << diagnostics_.to_text();
}

TEST_F(FilesTest, AreThoseThatPropertiesNameWithTheMeshesOfARobot) {
  write(
      "arm.yaml",
      "components:\n  Model: {model: Model, properties: {robot_description: "
      "\"${here}/urdf/arm.urdf\"}}\n"
      "  Other: {model: Other, properties: {Name: arm, Deep: {Files: [\"${here}/table.csv\"]}}}\n");
  write("urdf/arm.urdf",
        "<robot><mesh scale='1' filename=\"meshes/link.stl\"/>"
        "<mesh filename='package://arm/other.stl'/></robot>");
  write("urdf/meshes/link.stl", "");
  write("table.csv", "");
  EXPECT_THAT(found(),
              ElementsAre("arm.yaml", "table.csv", "urdf/arm.urdf", "urdf/meshes/link.stl"));
  EXPECT_TRUE(diagnostics_.ok());
  EXPECT_THAT(diagnostics_.to_text(), HasSubstr("the mesh 'package://arm/other.stl' is left out"));
}

TEST_F(FilesTest, ArePropertyFilesAndOnesThatARunIsYetToWrite) {
  write("arm.yaml",
        "components:\n  A: {model: A, property_file: a.cpf}\n"
        "  B: {model: B, property_file: b.cpf, autosave: true}\n");
  write("a.cpf", "<properties></properties>");
  EXPECT_THAT(found(), ElementsAre("a.cpf", "arm.yaml"));
  EXPECT_THAT(all_.saved, ElementsAre(path("b.cpf")));
}

TEST_F(FilesTest, AreThoseOfTheNetworkButNoPrivateKey) {
  write("arm.yaml",
        "network:\n  listen: [\"tls://0.0.0.0:4242\"]\n  policy: arm.policy\n  pages: page\n"
        "  tls: {certificate: arm.pem, key: arm.key, authority: ca.pem}\n");
  for (const char* const file :
       {"arm.policy", "arm.pem", "arm.key", "ca.pem", "page/index.html", "page/js/arm.js"}) {
    write(file, "");
  }
  fs::create_symlink("/etc/hostname", folder_ / "page/link");
  EXPECT_THAT(found(), ElementsAre("arm.pem", "arm.policy", "arm.yaml", "ca.pem", "page/index.html",
                                   "page/js/arm.js"));
  EXPECT_THAT(all_.keys, ElementsAre(path("arm.key")));
  EXPECT_THAT(diagnostics_.to_text(), HasSubstr("page/link' is a link: it is left out"));
}

TEST_F(FilesTest, AreInterfacesWithTheirImports) {
  write("arm.yaml",
        "components:\n  Ball: {remote: \"tcp://robot:4242/Vision\", interface: idl/ball.idl}\n");
  write("idl/ball.idl", "import \"geometry.idl\";\ninterface Vision { void look(); };\n");
  write("idl/geometry.idl", "struct Point { double x; };\n");
  EXPECT_THAT(found(), ElementsAre("arm.yaml", "idl/ball.idl", "idl/geometry.idl"));
}

TEST_F(FilesTest, AreTheScriptAndTheModulesThatItRequires) {
  write("arm.yaml", "application: arm\n");
  write("move.lua", "local poses = require(\"poses\")\nlocal table = require 'table'\n");
  write("poses.lua", "require('move')\n");
  EXPECT_THAT(found("move.lua"), ElementsAre("arm.yaml", "move.lua", "poses.lua"));
}

TEST_F(FilesTest, AreLibrariesByAPath) {
  write("arm.yaml", "libraries: [arm, ./lib/libother.so]\n");
  write("lib/libother.so", "");
  EXPECT_THAT(found(), ElementsAre("arm.yaml", "lib/libother.so"));
  EXPECT_THAT(all_.libraries, ElementsAre(path("lib/libother.so")));
}

TEST_F(FilesTest, AbsolutePathsAreRefusedWhereTheyStand) {
  write("arm.yaml",
        "network: {policy: " + path("'arm.policy'") +
            "}\ncomponents:\n  Model: {model: Model, properties: {robot_description: \"" +
            path("arm.urdf") + "\"}}\n");
  write("arm.policy", "");
  write("arm.urdf", "");
  found();
  EXPECT_EQ(diagnostics_.error_count(), 2u) << diagnostics_.to_text();
  EXPECT_THAT(diagnostics_.to_text(), HasSubstr(path("arm.yaml") + ":3:"));
  EXPECT_THAT(diagnostics_.to_text(),
              HasSubstr("property 'robot_description' of 'Model' has the absolute path '" +
                        path("arm.urdf") + "', which another machine does not have"));
}

TEST_F(FilesTest, APathFromTheWorkingDirectoryIsTold) {
  write("arm.yaml", "components:\n  Model: {model: Model, properties: {robot_description: \"" +
                        fs::relative(path("arm.urdf")).string() + "\"}}\n");
  write("arm.urdf", "");
  EXPECT_THAT(found(), ElementsAre("arm.yaml"));
  EXPECT_THAT(diagnostics_.to_text(), HasSubstr("a file that counts from the working directory"));
}

}  // namespace
}  // namespace armature::bundle::internal
