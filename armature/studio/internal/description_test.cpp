// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/description.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::studio::internal {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Described : ::testing::Test {
  Described() { fs::create_directories(folder); }
  ~Described() override { fs::remove_all(folder); }

  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = (folder / name).string();
    std::ofstream(path) << text;
    return path;
  }
  /// Of a check whose component has the property with this value.
  static std::string findings(const std::string& value,
                              const std::string& property = "robot_description") {
    return R"({"components": [{"name": "Other"}, {"name": "Robot", "properties": [{"name": ")" +
           property + R"(", "value": ")" + value + R"("}]}]})";
  }

  const fs::path folder = fs::path(::testing::TempDir()) / "description_test";
};

TEST_F(Described, IsGivenIfAComponentNamesIt) {
  const std::string text = "<?xml version=\"1.0\"?>\n<!-- <b> -->\n<robot name=\"a\"/>\n";
  const std::string path = file("a.urdf", text);
  EXPECT_EQ(read_description(path, findings(path)).value(), text);
}

TEST_F(Described, IsNotGivenIfNoComponentNamesItAsItsRobots) {
  const std::string path = file("a.urdf", "<robot/>");
  for (const std::string& found :
       {findings("b.urdf"), findings(path, "file"), std::string("{}"), std::string()}) {
    EXPECT_THAT(read_description(path, found).error(),
                HasSubstr("is no robot's description of this deployment"));
  }
  EXPECT_FALSE(read_description("", findings("")).ok());
}

TEST_F(Described, IsNotGivenIfItIsNone) {
  for (const char* text : {"root:x:0:0", "<html><robot/></html>", "<!-- <robot/>", "", "<?xml"}) {
    const std::string path = file("secret", text);
    EXPECT_THAT(read_description(path, findings(path)).error(), HasSubstr("expected <robot>"));
  }
  EXPECT_FALSE(read_description(folder.string(), findings(folder.string())).ok());
}

}  // namespace
}  // namespace armature::studio::internal
