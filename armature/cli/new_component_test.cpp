// SPDX-License-Identifier: Apache-2.0
// That what is made can be built and run is the affair of tests/new_component.
#include "armature/cli/new_component.hpp"

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class NewComponentTest : public ::testing::Test {
 protected:
  NewComponentTest() : parent_(fs::path(::testing::TempDir()) / "armature_new_component_test") {
    fs::remove_all(parent_);
    fs::create_directories(parent_);
  }
  ~NewComponentTest() override { fs::remove_all(parent_); }

  base::Result<NewFolder> make(const std::string& name) {
    return make_component_library(name, parent_.string());
  }
  std::string folder_of(const std::string& name) {
    const auto made = make(name);
    return made ? fs::path(made.value().folder).filename().string() : made.error();
  }

  fs::path parent_;
};

TEST_F(NewComponentTest, WritesAllItsFilesWithItsNames) {
  const auto made = make("GripperDriver");
  ASSERT_TRUE(made.ok()) << made.error();
  EXPECT_EQ(made.value().folder, (parent_ / "gripper_driver").string());
  EXPECT_THAT(made.value().files,
              ::testing::UnorderedElementsAre("CMakeLists.txt", "gripper_driver.hpp",
                                              "gripper_driver.cpp", "gripper_driver_test.cpp",
                                              "gripper_driver.yaml", "README.md", ".gitignore"));
  for (const std::string& file : made.value().files) {
    const std::string content = platform::read_file(made.value().folder + "/" + file).value();
    EXPECT_FALSE(content.empty()) << file;
    EXPECT_THAT(content, Not(HasSubstr("@"))) << file;
  }
  EXPECT_THAT(platform::read_file(made.value().folder + "/gripper_driver.hpp").value(),
              HasSubstr("class GripperDriver final : public Component"));
}

TEST_F(NewComponentTest, EitherSpellingOfANameWillDo) {
  EXPECT_EQ(folder_of("Pid"), "pid");
  EXPECT_EQ(folder_of("CANDriver2"), "can_driver2");
  EXPECT_EQ(folder_of("AIC"), "aic");
  ASSERT_TRUE(make("axis_filter").ok());
  EXPECT_THAT(platform::read_file((parent_ / "axis_filter/axis_filter.cpp").string()).value(),
              HasSubstr("AxisFilter::on_update()"));
}

TEST_F(NewComponentTest, ANameThatIsNoIdentifierIsRefused) {
  for (const char* name : {"", "1st", "my-driver", "my driver", "../up", "a.b", "_x", "Übung"}) {
    EXPECT_THAT(folder_of(name), HasSubstr("must begin with a letter")) << name;
  }
  EXPECT_THAT(folder_of("a__b"), HasSubstr("has a '_' at its end or two in a row"));
  EXPECT_THAT(folder_of("a_"), HasSubstr("has a '_' at its end or two in a row"));
  EXPECT_THAT(folder_of(std::string(65, 'a')), HasSubstr("is longer than 64 letters"));
  EXPECT_TRUE(fs::is_empty(parent_));
}

TEST_F(NewComponentTest, AWordThatIsTakenIsRefused) {
  EXPECT_EQ(folder_of("Switch"),
            "the name 'Switch' would make a library 'switch', which is a word of C++, CMake or "
            "Armature; choose a longer name, such as 'SwitchDriver'");
  for (const char* name : {"class", "Test", "Component", "install", "InputPort", "Source"}) {
    EXPECT_THAT(folder_of(name), HasSubstr("is a word of")) << name;
  }
}

TEST_F(NewComponentTest, AFolderThatExistsIsLeftAlone) {
  fs::create_directories(parent_ / "pid");
  EXPECT_THAT(folder_of("Pid"), HasSubstr("pid' exists already"));
  EXPECT_TRUE(fs::is_empty(parent_ / "pid"));
}

TEST_F(NewComponentTest, AParentThatIsNoFolderIsNamed) {
  EXPECT_THAT(make_component_library("Pid", "/nowhere").error(),
              HasSubstr("cannot make the folder '/nowhere/pid': No such file or directory"));
}

}  // namespace
}  // namespace armature::cli
