// SPDX-License-Identifier: Apache-2.0
// The arm is led by a hand while it is weightless, and plays what it was taught.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/fixed_text.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::HasSubstr;
using Name = base::FixedText<63>;

std::string folder() {
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  return ::testing::TempDir() + "wam_teach_" + test->name();
}

class WamTaught : public ::testing::Test {
 protected:
  WamTaught()
      : arm("../demo/teach.yaml",
            {"Teacher.folder=" + folder(), "Teacher.poses=" + folder() + "/poses.yaml",
             "Reporter.file=", "Reporter.csv=" + folder() + "/wam.csv"}) {}
  ~WamTaught() override { std::filesystem::remove_all(folder()); }

  void SetUp() override {
    std::filesystem::remove_all(folder());
    std::filesystem::create_directories(folder());
    arm.start_armed();
    ASSERT_EQ(
        run("Generator", "moveTo",
            {types::Value::of(Vector{0.5, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5}), types::Value::of(4.0)}),
        "");
    arm.run_for(500ms);
    switch_to("weightless");
    arm.run_for(1s);
  }
  void switch_to(const std::string& mode) { ASSERT_TRUE(arm.application().switch_mode(mode)); }
  component::CommandHandle begin(const char* component, const char* command,
                                 std::vector<types::Value> arguments) {
    auto begun = arm.application().begin(component, command, std::move(arguments));
    EXPECT_TRUE(begun) << begun.error();
    return std::move(begun).value();
  }
  /// @return why it was not done, or nothing
  std::string run(const char* component, const char* command, std::vector<types::Value> arguments) {
    auto begun = arm.application().begin(component, command, std::move(arguments));
    if (!begun) return begun.error();
    for (int i = 0; i < 30000 && !begun.value().ended(); ++i) arm.cycle();
    return begun.value().stage() == CommandStage::kDone ? "" : std::string(begun.value().reason());
  }
  /// A hand swings shoulder, elbow and wrist, and lets go.
  void teach() {
    auto recording = begin("Teacher", "record", {types::Value::of(Name("wave"))});
    arm.run_for(200ms);
    for (int i = 0; i < 200; ++i) {
      const double swing = 0.2 * std::cos(6.2831853 * i / 200.0);
      ASSERT_EQ(arm.call("WAM", "leadByHand",
                         {types::Value::of(Vector{swing, 0.6 * swing, 0, -swing, 0, swing, 0})}),
                "");
      arm.run_for(10ms);
      taught.push_back(measured());
    }
    arm.run_for(500ms);
    taught.push_back(measured());
    ASSERT_EQ(run("Teacher", "finish", {}), "") << arm.log;
    arm.run_for(10ms);
    ASSERT_EQ(recording.stage(), CommandStage::kDone);
  }
  Vector measured() {
    Vector all = arm.value<Vector>("Sensor", "sensor");
    all.resize(7);
    return all;
  }
  std::string play(double speed) {
    return run("Teacher", "play", {types::Value::of(Name("wave")), types::Value::of(speed)});
  }
  /// How far from the nearest of all places on the taught path the arm is while it plays.
  double furthest_while_playing(double speed) {
    auto playing =
        begin("Teacher", "play", {types::Value::of(Name("wave")), types::Value::of(speed)});
    std::vector<Vector> places;
    for (int i = 0; i < 60000 && !playing.ended(); ++i) {
      arm.cycle();
      if (i % 5 == 0) places.push_back(measured());
    }
    EXPECT_EQ(playing.stage(), CommandStage::kDone) << playing.reason() << arm.log;
    double furthest = 0.0;
    for (const Vector& each : taught) {
      double nearest = 1e9;
      for (const Vector& place : places) nearest = std::min(nearest, largest_apart(each, place));
      furthest = std::max(furthest, nearest);
    }
    return furthest;
  }

  Arm arm;
  std::vector<Vector> taught;
};

TEST_F(WamTaught, PlaysWhatAHandTaughtWithinAHundredthOfARadianAtEverySpeed) {
  teach();
  const Vector end = taught.back();
  EXPECT_GT(largest_apart(taught.front(), taught[50]), 0.02) << "the hand has moved it";
  switch_to("npid");
  arm.run_for(1s);
  EXPECT_LT(largest_apart(measured(), end), 0.01) << "no bump: it stays where the hand left it";
  for (const double speed : {1.0, 0.1, 3.0}) {
    EXPECT_LT(furthest_while_playing(speed), 0.01) << speed;
    EXPECT_LT(largest_apart(arm.desired(), end), 0.01) << speed;
  }
  EXPECT_EQ(arm.application().faults(), 0u) << arm.log;
}

TEST_F(WamTaught, FromFarAwayItMovesToTheBeginFirst) {
  teach();
  switch_to("npid");
  arm.run_for(500ms);
  ASSERT_EQ(arm.move_to({-0.5, 0.5, 0.0, 1.0, 0.0, 0.0, 0.0}, 0.0), "");
  arm.run_for(8s);
  EXPECT_LT(furthest_while_playing(1.0), 0.01);
  EXPECT_EQ(arm.application().faults(), 0u) << arm.log;
}

TEST_F(WamTaught, IsRefusedWhileAHandLeadsAndWhenItIsNotArmed) {
  teach();
  EXPECT_THAT(play(1.0), HasSubstr("a hand leads the robot in the mode 'weightless'"));
  switch_to("npid");
  arm.run_for(500ms);
  ASSERT_EQ(arm.call("Arming", "disarm"), "");
  arm.run_for(100ms);
  const Vector there = arm.positions();
  EXPECT_EQ(play(1.0), "the robot is not armed: arm first");
  EXPECT_EQ(run("Teacher", "play", {types::Value::of(Name("wav")), types::Value::of(1.0)}),
            "unknown motion 'wav' (did you mean 'wave'?)");
  arm.run_for(500ms);
  EXPECT_LT(largest_apart(arm.positions(), there), 0.01);
}

TEST_F(WamTaught, NothingGoesOnAfterTheEmergencyStopAndArmingAgain) {
  teach();
  switch_to("npid");
  arm.run_for(500ms);
  auto playing = begin("Teacher", "play", {types::Value::of(Name("wave")), types::Value::of(0.3)});
  arm.run_for(3s);
  ASSERT_FALSE(playing.ended()) << playing.reason();
  ASSERT_EQ(arm.call("Arming", "disarm"), "");
  arm.run_for(1s);
  EXPECT_EQ(playing.stage(), CommandStage::kFailed);
  arm.arm();
  const Vector there = arm.positions();
  arm.run_for(3s);
  EXPECT_LT(largest_apart(arm.positions(), there), 0.01) << "nothing goes on";
}

TEST_F(WamTaught, PosesAreKeptByNameAndMovedTo) {
  const Vector there = measured();
  ASSERT_EQ(run("Teacher", "keepPose", {types::Value::of(Name("here"))}), "");
  switch_to("npid");
  arm.run_for(500ms);
  ASSERT_EQ(arm.move_to({0.0, -1.0, 0.0, 1.5, 0.0, 0.0, 0.0}, 0.0), "");
  arm.run_for(6s);
  ASSERT_EQ(run("Teacher", "goTo", {types::Value::of(Name("here")), types::Value::of(0.0)}), "");
  arm.run_for(1s);
  EXPECT_LT(largest_apart(measured(), there), 0.01);
}

}  // namespace
}  // namespace armature::wam
