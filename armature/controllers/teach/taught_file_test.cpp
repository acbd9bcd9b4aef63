// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/teach/taught_file.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::controllers {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const control::TaughtSamples kSamples{
    2, {5.0, 5.01, 5.02}, {0.1, -0.2, 0.1000004, -0.21, 1.5, 0.0}};

TEST(MotionText, IsReadableAndReadBack) {
  const std::string text = to_motion_text("wave", kSamples);
  EXPECT_EQ(
      text,
      "# A taught motion: of each sample the time [s] and the positions [rad] of the joints.\n"
      "motion: wave\njoints: 2\nsamples: 3\n"
      "0.000000: [0.1, -0.2]\n0.010000: [0.1, -0.21]\n0.020000: [1.5, 0]\n");
  const auto read = read_motion_text(text, 2);
  ASSERT_TRUE(read) << read.error();
  EXPECT_THAT(read.value().times_s, ElementsAre(0.0, 0.01, 0.02));
  EXPECT_THAT(read.value().positions, ElementsAre(0.1, -0.2, 0.1, -0.21, 1.5, 0.0));
}

std::string changed(const std::string& what, const std::string& into) {
  std::string text = to_motion_text("wave", kSamples);
  return text.replace(text.find(what), what.size(), into);
}

TEST(MotionText, MistakesAreToldByTheirLine) {
  const auto mistake = [](const std::string& text) { return read_motion_text(text, 2).error(); };
  EXPECT_EQ(mistake(changed("-0.21", "abc")), "line 6: expected a finite number, found 'abc'");
  EXPECT_EQ(mistake(changed("-0.21", "nan")), "line 6: expected a finite number, found 'nan'");
  EXPECT_EQ(mistake(changed(", -0.21", "")), "line 6: has 1 positions, the robot has 2 joints");
  EXPECT_EQ(mistake(changed("0.020000", "0.010000")),
            "line 7: the time 0.010000 s is not later than that of the sample before it");
  EXPECT_EQ(mistake(changed("joints: 2", "joints: 7")),
            "line 3: the motion has 7 joints, the robot has 2");
  EXPECT_EQ(mistake(changed("samples: 3", "samples: x")),
            "line 4: samples must be a whole number above 0, found 'x'");
  EXPECT_EQ(mistake(changed("1.5, 0]", "1.5, 0")),
            "line 7: expected the positions of all joints, such as [0.1, -0.2], found '[1.5, 0'");
  EXPECT_EQ(mistake(changed("0.020000: [1.5, 0]\n", "")),
            "line 6: the file has 2 samples, it says 3: it was cut off or edited");
  EXPECT_EQ(mistake(""), "line 1: expected a line such as samples: 100, found none");
  EXPECT_THAT(mistake("\x01\x02 garbage"), HasSubstr("line 1: expected a sample"));
}

TEST(MotionText, WhereverAFileIsCutOffItIsRefused) {
  const std::string whole = to_motion_text("wave", kSamples);
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    EXPECT_FALSE(read_motion_text(whole.substr(0, size), 2)) << size;
  }
}

TEST(PoseText, APoseIsALineInTheUnitThatItSays) {
  const auto poses = read_pose_text(
      "# where the arm is\n\nhome: [0, -90] deg   # at the stops\nover_table: [0.5, 1e-1] rad\n",
      2);
  ASSERT_TRUE(poses) << poses.error();
  EXPECT_THAT(poses.value().at("home"), ElementsAre(0.0, DoubleNear(-1.5707963, 1e-7)));
  EXPECT_THAT(poses.value().at("over_table"), ElementsAre(0.5, 0.1));
  EXPECT_THAT(read_pose_text("lift: [250, 0] mm\n", 2).value().at("lift"), ElementsAre(0.25, 0.0));
}

TEST(PoseText, IsWrittenAsItIsRead) {
  const Poses poses{{"home", {0.0, -1.5707963}}, {"up", {0.1, 0.2}}};
  const std::string text = to_pose_text(poses, "deg");
  EXPECT_THAT(text, HasSubstr("\nhome: [0, -89.999998] deg\nup: [5.729578, 11.459156] deg\n"));
  const auto read = read_pose_text(text, 2);
  ASSERT_TRUE(read) << read.error();
  EXPECT_THAT(read.value().at("up"), ElementsAre(DoubleNear(0.1, 1e-7), DoubleNear(0.2, 1e-7)));
}

TEST(PoseText, AllMistakesAreToldByTheirLines) {
  EXPECT_EQ(read_pose_text("home: [0, 1] deg\n"
                           "up: [0, 1]\n"
                           "far: [0] rad\n"
                           "home: [0, 2] deg\n"
                           "not a pose\n"
                           "wide: [x, 1] rad\n",
                           2)
                .error(),
            "line 2: pose 'up': expected a unit behind the positions, rad or deg (m or mm), found "
            "''\n"
            "line 3: pose 'far': has 1 positions, the robot has 2 joints\n"
            "line 4: a second pose 'home'\n"
            "line 5: expected a pose, such as home: [0, 45] deg, found 'not a pose'\n"
            "line 6: pose 'wide': expected a finite number, found 'x'");
}

TEST(TaughtName, IsAFilesNameWithoutPath) {
  for (const char* good : {"wave", "over_table-2", "A"}) EXPECT_TRUE(is_taught_name(good));
  for (const char* bad : {"", "../wave", "a b", "a/b", ".", "\xc3\xa4"}) {
    EXPECT_FALSE(is_taught_name(bad)) << bad;
  }
  EXPECT_FALSE(is_taught_name(std::string(64, 'a')));
}

}  // namespace
}  // namespace armature::controllers
