// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/cartesian/inverse_kinematics.hpp"
#include "armature/control/cartesian/pose_path.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {

using namespace std::chrono_literals;
using component::CommandStage;
using control::Pose;
using control::PosePath;

/// The arm of robots/wam/demo/paths.yaml, armed, where its tool has room; its Planner is asked.
class WamOnPaths : public ::testing::Test {
 protected:
  WamOnPaths() : arm("../demo/paths.yaml", {}) {
    base::Diagnostics diagnostics;
    kinematics_ = control::InverseKinematics::load(
        WAM "/wam7.urdf", {.base_link = {}, .tip_link = "tool"}, diagnostics);
  }
  void SetUp() override {
    arm.start_armed();
    ASSERT_EQ(
        run("Generator", "moveTo",
            {types::Value::of(Vector{0.2, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5}), types::Value::of(4.0)}),
        "");
    arm.run_for(500ms);
    begin_ = kinematics_->pose_at(desired());
  }
  Vector desired() { return arm.value<Vector>("Generator", "nAxesDesiredPosition"); }
  /// Where it began, and so much beside [m].
  Pose beside(double x, double y, double z) {
    control::PoseNumbers numbers = control::numbers_of(begin_);
    numbers[0] += x;
    numbers[1] += y;
    numbers[2] += z;
    return control::pose_of(numbers);
  }
  static Vector numbers(const std::vector<Pose>& poses) {
    Vector all;
    for (const Pose& pose : poses) {
      const control::PoseNumbers one = control::numbers_of(pose);
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  }
  /// @return why it was not done, or nothing
  std::string run(
      const char* component, const char* command, std::vector<types::Value> arguments,
      const std::function<void()>& each_cycle = [] {}) {
    auto begun = arm.application().begin(component, command, std::move(arguments));
    if (!begun) return begun.error();
    for (int i = 0; i < 30000 && !begun.value().ended(); ++i) {
      arm.cycle();
      each_cycle();
    }
    return begun.value().stage() == CommandStage::kDone ? "" : std::string(begun.value().reason());
  }
  /// Follows a path, and looks at the tool's reference and at the tool.
  void follow(const char* command, std::vector<types::Value> arguments, const PosePath& path) {
    double off = 0.0;
    double arm_off = 0.0;
    double fastest = 0.0;
    Pose last = kinematics_->pose_at(desired());
    const auto look = [&] {
      const Pose wanted = kinematics_->pose_at(desired());
      fastest = std::max(fastest, control::distance(wanted, last).way / 0.002);
      last = wanted;
      off = std::max(off, distance_from(path, wanted));
      arm_off = std::max(arm_off, distance_from(path, kinematics_->pose_at(measured())));
    };
    ASSERT_EQ(run("Planner", command, std::move(arguments), look), "") << arm.log;
    arm.run_for(500ms);
    EXPECT_LT(off, 0.0015) << "max_deviation, and a millimetre of what it is compared with";
    EXPECT_LT(arm_off, 0.02) << "the arm lags behind, mostly along the path";
    EXPECT_LT(fastest, 0.26) << "max_tool_velocity";
    EXPECT_LT(control::distance(kinematics_->pose_at(desired()), path.at(path.length())).way, 1e-3);
    EXPECT_LT(control::distance(kinematics_->pose_at(measured()), path.at(path.length())).way,
              5e-3);
    EXPECT_TRUE(arm.armed()) << arm.log;
  }
  static double distance_from(const PosePath& path, const Pose& pose) {
    double nearest = 1.0;
    const int steps = static_cast<int>(path.length() / 0.001);
    for (int i = 0; i <= steps; ++i) {
      nearest = std::min(nearest, control::distance(path.at(path.length() * i / steps), pose).way);
    }
    return nearest;
  }
  Vector measured() {
    Vector all = arm.value<Vector>("Sensor", "sensor");
    all.resize(7);
    return all;
  }
  void expect_refused(const char* command, std::vector<types::Value> arguments,
                      const ::testing::Matcher<std::string>& why) {
    const Vector before = desired();
    EXPECT_THAT(run("Planner", command, std::move(arguments)), why);
    arm.run_for(500ms);
    EXPECT_EQ(desired(), before) << "nothing moves";
  }

  Arm arm;
  std::optional<control::InverseKinematics> kinematics_;
  Pose begin_;
};

}  // namespace armature::wam
