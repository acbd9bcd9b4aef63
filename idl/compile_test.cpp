// SPDX-License-Identifier: Apache-2.0
#include "idl/compile.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "idl/internal/test_program.hpp"

namespace armature::idl {
namespace {

namespace fs = std::filesystem;
using internal::TestFiles;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Compile : public ::testing::Test {
 protected:
  Compile() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / ("rcidl_" + std::string(test->name()));
    fs::remove_all(folder_);
    options_.file = "robot/chassis.idl";
    options_.output_folder = (folder_ / "out").string();
  }
  ~Compile() override { fs::remove_all(folder_); }

  std::string compiled() { return compile(options_, internal::reader_of(files_)); }

  std::set<std::string> written() const {
    std::set<std::string> names;
    if (!fs::exists(options_.output_folder)) return names;
    for (const auto& entry : fs::directory_iterator(options_.output_folder)) {
      names.insert(entry.path().filename());
    }
    return names;
  }

  std::string content(const std::string& name) const {
    std::ifstream file(fs::path(options_.output_folder) / name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }

  fs::path folder_;
  CompileOptions options_;
  TestFiles files_{{"robot/chassis.idl",
                    "import \"parts/wheel.idl\"; interface Chassis { struct Wheel left(); };"},
                   {"robot/parts/wheel.idl", "struct Wheel { double radius; };"}};
};

TEST_F(Compile, WritesFiveFilesAndTheFolder) {
  EXPECT_EQ(compiled(), "");
  EXPECT_THAT(written(),
              ElementsAre("chassis_client.cpp", "chassis_client.hpp", "chassis_service.cpp",
                          "chassis_service.hpp", "chassis_types.hpp"));
  EXPECT_THAT(content("chassis_types.hpp"), HasSubstr("#include \"wheel_types.hpp\""));
  EXPECT_THAT(content("chassis_client.hpp"), HasSubstr("Answer<wheel::Wheel> left("));
}

TEST_F(Compile, WritesTheSameAgain) {
  EXPECT_EQ(compiled(), "");
  const std::string first = content("chassis_client.cpp");
  fs::remove_all(options_.output_folder);
  EXPECT_EQ(compiled(), "");
  EXPECT_EQ(content("chassis_client.cpp"), first);
}

TEST_F(Compile, ANamespaceIsThatOfImportedFilesToo) {
  options_.name_space = "robot::parts";
  EXPECT_EQ(compiled(), "");
  EXPECT_THAT(content("chassis_client.hpp"), HasSubstr("namespace robot::parts {"));
  EXPECT_THAT(content("chassis_client.hpp"), HasSubstr("Answer<Wheel> left("));
}

TEST_F(Compile, ANamespaceThatCppCannotHaveIsRefused) {
  for (const std::string name : {"class", "a::", "1a", "std", "a b", "robot::armature", "-", ""}) {
    options_.name_space = name;
    EXPECT_THAT(compiled(), HasSubstr("'" + name + "' cannot be a namespace of C++")) << name;
  }
  EXPECT_THAT(written(), IsEmpty());
}

TEST_F(Compile, AFilesNameHasToBeANamespaceUnlessOneIsGiven) {
  options_.file = "my-robot.idl";
  files_["my-robot.idl"] = "interface I { void f(); };";
  EXPECT_THAT(compiled(), HasSubstr("hint: choose one with --namespace NAME"));
  options_.name_space = "robot";
  EXPECT_EQ(compiled(), "");
}

TEST_F(Compile, AMistakeLeavesEveryFileAsItWas) {
  EXPECT_EQ(compiled(), "");
  const std::string before = content("chassis_types.hpp");
  files_["robot/chassis.idl"] = "interface Chassis { int left(; };";
  EXPECT_THAT(compiled(), HasSubstr("robot/chassis.idl:1:30: error: "));
  EXPECT_EQ(content("chassis_types.hpp"), before);
  EXPECT_EQ(written().size(), 5u);
}

TEST_F(Compile, WhereOneFileCannotBeWrittenNoneIs) {
  EXPECT_EQ(compiled(), "");
  const std::string before = content("chassis_client.hpp");
  fs::remove(fs::path(options_.output_folder) / "chassis_service.cpp");
  fs::create_directory(fs::path(options_.output_folder) / "chassis_service.cpp");
  files_["robot/chassis.idl"] = "interface Chassis { void stop(); };";
  EXPECT_THAT(compiled(), HasSubstr("chassis_service.cpp': it is not a file"));
  EXPECT_EQ(content("chassis_client.hpp"), before);
  EXPECT_EQ(written().size(), 5u);
}

TEST_F(Compile, AFolderThatCannotBeMadeIsNamed) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "out") << "a file";
  EXPECT_THAT(compiled(), HasSubstr("rcidl: error: cannot make the folder"));
}

TEST_F(Compile, WhatHasNotChangedIsNotWritten) {
  EXPECT_EQ(compiled(), "");
  const fs::path types = fs::path(options_.output_folder) / "chassis_types.hpp";
  const fs::path client = fs::path(options_.output_folder) / "chassis_client.hpp";
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(24);
  fs::last_write_time(types, long_ago);
  fs::last_write_time(client, long_ago);
  files_["robot/chassis.idl"] += " // a comment";
  EXPECT_EQ(compiled(), "");
  EXPECT_EQ(fs::last_write_time(types), long_ago);
  files_["robot/chassis.idl"] =
      "import \"parts/wheel.idl\"; interface Chassis { struct Wheel right(); };";
  EXPECT_EQ(compiled(), "");
  EXPECT_NE(fs::last_write_time(client), long_ago);
}

TEST_F(Compile, TellsNinjaWhichFilesWereRead) {
  options_.output_folder = (folder_ / "with blank").string();
  options_.depends = (folder_ / "with blank" / "chassis.d").string();
  EXPECT_EQ(compiled(), "");
  const std::string rule = content("chassis.d");
  EXPECT_THAT(rule, HasSubstr("/with\\ blank/chassis_types.hpp "));
  EXPECT_THAT(rule, HasSubstr(": \\\n  robot/chassis.idl \\\n  robot/parts/wheel.idl\n"));
}

TEST_F(Compile, WritesJsonIfAskedTo) {
  options_.json = true;
  EXPECT_EQ(compiled(), "");
  EXPECT_EQ(written().count("chassis.json"), 1u);
}

TEST_F(Compile, NamesThatCppKeepsForItselfAreTaken) {
  files_["robot/chassis.idl"] =
      "struct _Pose { int _1; int a__b; }; interface Chassis { struct _Pose __get(int _x); };";
  EXPECT_EQ(compiled(), "");
  EXPECT_THAT(content("chassis_types.hpp"), HasSubstr("ARMATURE_STRUCT(Pose_, _1, a_b);"));
  EXPECT_THAT(content("chassis_types.hpp"), HasSubstr("struct _Pose{int,int} __get(int)"));
  EXPECT_THAT(content("chassis_client.hpp"), HasSubstr("Answer<Pose_> _get(std::int32_t _x,"));
}

TEST_F(Compile, AnOperationThatIsCalledLikeTheHandlerOfAnEventIsNamedAnew) {
  files_["robot/chassis.idl"] =
      "event Bumped { int x; }; interface Chassis { void on_Bumped(); event Bumped; };";
  EXPECT_EQ(compiled(), "");
  EXPECT_THAT(content("chassis_client.hpp"), HasSubstr("Sent on_Bumped_("));
  EXPECT_THAT(content("chassis_client.hpp"), HasSubstr("Subscription on_Bumped("));
}

TEST_F(Compile, AFileThatIsCalledLikeAFunctionOfTheCLibraryHasANamespaceOfItsOwn) {
  options_.file = "time.idl";
  files_["time.idl"] = "interface I { void f(); };";
  EXPECT_EQ(compiled(), "");
  EXPECT_THAT(content("time_types.hpp"), HasSubstr("namespace time_ {"));
}

TEST_F(Compile, AByteOrderMarkIsNoPartOfTheText) {
  files_["robot/chassis.idl"] = "\xef\xbb\xbfinterface Chassis { void f(); };";
  EXPECT_EQ(compiled(), "");
  files_["robot/chassis.idl"] = "\xef\xbb\xbfinterfac Chassis { void f(); };";
  EXPECT_THAT(compiled(), HasSubstr("chassis.idl:1:1: error: "));
}

TEST_F(Compile, TheGreatestFloatMayBeWrittenWithAsManyDigitsAsTellIt) {
  files_["robot/chassis.idl"] =
      "interface Chassis { void f([range(-3.4028235e38, 3.4028235e38)] float a); };";
  EXPECT_EQ(compiled(), "");
  EXPECT_THAT(content("chassis_service.cpp"), HasSubstr("3.4028235e+38f"));
  files_["robot/chassis.idl"] = "interface Chassis { void f([range(0, 3.4028236e38)] float a); };";
  EXPECT_THAT(compiled(), HasSubstr("expected a decimal number that 'float' holds"));
}

TEST_F(Compile, MessagesShowWhatATerminalWouldObey) {
  files_["robot/chassis.idl"] = "interface Chassis { \x1b[2J void f(); }; /* \xe2\x80\xae */ x";
  const std::string answer = compiled();
  EXPECT_THAT(answer, HasSubstr("interface Chassis { \\x1b[2J void f(); }; /* \\u202e */ x\n"));
  EXPECT_THAT(answer, ::testing::Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace armature::idl
