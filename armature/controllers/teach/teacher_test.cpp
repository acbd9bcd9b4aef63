// SPDX-License-Identifier: Apache-2.0
// The Teacher of a robot with two joints, without a generator, in simulated cycles of 10 ms.
#include "armature/controllers/teach/teacher.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/fixed_text.hpp"
#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using component::CommandStage;
using ::testing::Contains;
using ::testing::HasSubstr;
using Name = base::FixedText<63>;
using Vector = std::vector<double>;

/// Where one test keeps its files.
class Folder {
 public:
  Folder() {
    path_ =
        std::filesystem::path(::testing::TempDir()) /
        (std::string("teacher_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string text(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path_ / name).rdbuf();
    return text.str();
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }

 private:
  std::filesystem::path path_;
};

class Teaching : public ::testing::Test {
 protected:
  Teaching() : teacher(std::make_unique<Teacher>("Teacher"), std::chrono::milliseconds(10)) {
    teacher.set("joints", 2);
    teacher.set("folder", folder.file(""));
    teacher.set("poses", folder.file("poses.yaml"));
    teacher.set("max_duration", 2.0);
  }
  void start() { ASSERT_TRUE(teacher.start()) << teacher.reason(); }
  /// A hand swings the first joint.
  void lead(int cycles) {
    for (int i = 0; i < cycles; ++i, ++led) {
      teacher.write("nAxesSensorPosition", Vector{std::sin(0.02 * led), 0.5});
      teacher.run_cycles();
    }
  }
  template <typename... Arguments>
  std::string refusal(const char* command, const Arguments&... arguments) {
    const auto answer = teacher.call(command, arguments...);
    return answer ? "accepted" : answer.error();
  }

  Folder folder;
  testing::Harness teacher;
  int led = 0;
};

TEST_F(Teaching, ARecordingIsKeptInAFileThatReadsWell) {
  start();
  lead(1);
  auto recording = teacher.send("record", Name("wave"));
  lead(100);
  EXPECT_NEAR(recording.progress(), 0.5, 0.02);
  EXPECT_NEAR(teacher.get<double>("recorded_time"), 1.0, 0.02);
  EXPECT_EQ(refusal("finish"), "accepted");
  lead(1);
  EXPECT_EQ(recording.stage(), CommandStage::kDone);
  const std::string text = folder.text("wave.motion");
  EXPECT_THAT(text,
              HasSubstr("motion: wave\njoints: 2\nsamples: 100\n0.000000: [0.019999, 0.5]\n"));
  EXPECT_TRUE(read_motion_text(text, 2));
  EXPECT_EQ(teacher.call<std::string>("list").value(), "motions: wave; poses:");
}

TEST_F(Teaching, AFullRecordingEndsIsKeptAndSaysSo) {
  start();
  lead(1);
  auto recording = teacher.send("record", Name("long"));
  lead(250);
  EXPECT_EQ(recording.stage(), CommandStage::kDone);
  EXPECT_THAT(teacher.log(), Contains(HasSubstr("'long' is full after 2 s (max_duration)")));
  EXPECT_THAT(folder.text("long.motion"), HasSubstr("\n2.000000: ["));
  EXPECT_EQ(refusal("finish"), "nothing is recorded: record first");
}

TEST_F(Teaching, ACancelledRecordingIsDropped) {
  start();
  lead(1);
  auto recording = teacher.send("record", Name("wave"));
  lead(50);
  recording.cancel();
  lead(2);
  EXPECT_EQ(recording.stage(), CommandStage::kCancelled);
  EXPECT_EQ(refusal("finish"), "nothing is recorded: record first");
  EXPECT_EQ(teacher.call<std::string>("list").value(), "motions:; poses:");
}

TEST_F(Teaching, ARecordingFailsWhereNothingIsMeasured) {
  start();
  EXPECT_THAT(refusal("record", Name("wave")), HasSubstr("its writer must run first"));
  lead(1);
  auto recording = teacher.send("record", Name("wave"));
  lead(50);
  teacher.run_cycles(12);
  EXPECT_EQ(recording.stage(), CommandStage::kFailed);
  EXPECT_THAT(recording.reason(), HasSubstr("nothing was measured for 100 ms"));
}

TEST_F(Teaching, AnEmptyRecordingIsRefusedAndKeepsWhatWasThere) {
  folder.write("wave.motion", "old");
  start();
  lead(1);
  auto recording = teacher.send("record", Name("wave"));
  EXPECT_THAT(refusal("finish"), HasSubstr("samples, expected at least 4"));
  EXPECT_EQ(recording.stage(), CommandStage::kFailed);
  EXPECT_EQ(folder.text("wave.motion"), "old");
}

TEST_F(Teaching, MistakesOfNamesAndFilesAreRefusedWithTheirPlace) {
  folder.write("wave.motion", "motion: wave\njoints: 2\nsamples: 9\n0.0: [1, 2]\n0.01: [1, x]\n");
  folder.write("seven.motion", "motion: seven\njoints: 7\n");
  start();
  lead(1);
  EXPECT_EQ(refusal("play", Name("wavee"), 1.0), "unknown motion 'wavee' (did you mean 'wave'?)");
  EXPECT_THAT(refusal("play", Name("wave"), 1.0),
              HasSubstr("wave.motion: line 5: expected a finite number, found 'x'"));
  EXPECT_THAT(refusal("play", Name("seven"), 1.0),
              HasSubstr("line 2: the motion has 7 joints, the robot has 2"));
  EXPECT_THAT(refusal("record", Name("../up")), HasSubstr("must have letters, digits, _ and -"));
  EXPECT_THAT(refusal("keepPose", Name("a b")), HasSubstr("must have letters"));
  EXPECT_EQ(refusal("goTo", Name("home"), 1.0), "unknown pose 'home'");
  folder.write("poses.yaml", "home: [1, 2]\n");
  EXPECT_THAT(refusal("goTo", Name("home"), 1.0), HasSubstr("poses.yaml: line 1: pose 'home'"));
  EXPECT_THAT(refusal("keepPose", Name("here")), HasSubstr("poses.yaml: line 1: pose 'home'"));
  EXPECT_EQ(folder.text("poses.yaml"), "home: [1, 2]\n");
}

TEST_F(Teaching, APoseIsKeptBesideTheOthers) {
  folder.write("poses.yaml", "# mine\nhome: [1, 2] rad\n");
  start();
  lead(1);
  EXPECT_EQ(refusal("keepPose", Name("here")), "accepted");
  const auto poses = read_pose_text(folder.text("poses.yaml"), 2);
  ASSERT_TRUE(poses) << poses.error();
  EXPECT_NEAR(poses.value().at("home")[1], 2.0, 1e-7);
  EXPECT_NEAR(poses.value().at("here")[1], 0.5, 1e-7);
  EXPECT_THAT(folder.text("poses.yaml"), HasSubstr("here: [0, 28.64789] deg"));
}

}  // namespace
}  // namespace armature::controllers
