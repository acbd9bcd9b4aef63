// SPDX-License-Identifier: Apache-2.0
// An own arm of three joints is taught and plays: the arm of examples/07_own_robot, whose weight
// the PIDs hold, so that a motion of its generator stands for the hand.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/base/fixed_text.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using Name = base::FixedText<63>;
using Vector = std::vector<double>;

constexpr const char* kTeach = R"(
include: arm.yaml
components:
  Generator: {override: true, model: nAxesGeneratorTaught}
  Teacher:
    model: Teacher
    activity: {periodic: 10 ms, scheduler: other}
    peers: [Generator]
    properties: {joints: 3}
connections:
  - BridgeRef.nAxesSensorPosition -> Teacher.nAxesSensorPosition
)";

class TaughtArm : public ::testing::Test {
 protected:
  TaughtArm() {
    std::filesystem::remove_all(folder_);
    deploy::DeploymentOptions options;
    options.library_folders = {ROBOT_LIBRARY, SERVO_LIBRARY};
    options.document.overrides = {"Teacher.folder=" + folder_};
    deployment_ = deploy::parse_deployment(kTeach, EXAMPLES "/07_own_robot/teach.yaml", options);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    const auto started = application_->start();
    EXPECT_TRUE(started.ok()) << started.to_text();
    application_->run_for(105ms);
    EXPECT_EQ(run("Arming", "arm", {}), "");
  }
  ~TaughtArm() override {
    application_.reset();
    std::filesystem::remove_all(folder_);
  }
  component::CommandHandle begin(const char* component, const char* command,
                                 std::vector<types::Value> arguments) {
    auto begun = application_->begin(component, command, std::move(arguments));
    EXPECT_TRUE(begun) << begun.error();
    return std::move(begun).value();
  }
  /// @return why it was not done, or nothing; all that was measured meanwhile is kept
  std::string run(const char* component, const char* command, std::vector<types::Value> arguments) {
    auto begun = begin(component, command, std::move(arguments));
    places.clear();
    asked.clear();
    for (int k = 0; k < 10000 && !begun.ended(); ++k) {
      application_->run_for(10ms);
      places.push_back(measured());
      asked.push_back(desired());
    }
    return begun.stage() == CommandStage::kDone ? "" : std::string(begun.reason());
  }
  std::string move_to(Vector positions) {
    return run("Generator", "moveTo", {types::Value::of(positions), types::Value::of(4.0)});
  }
  std::string play(double speed) {
    return run("Teacher", "play", {types::Value::of(Name("lift")), types::Value::of(speed)});
  }
  std::string refusal_to_play() {
    const auto answer = application_->begin(
        "Teacher", "play", {types::Value::of(Name("lift")), types::Value::of(1.0)});
    application_->run_for(200ms);
    return answer ? "accepted" : answer.error();
  }
  Vector measured() {
    Vector all;
    for (int joint = 1; joint <= 3; ++joint) {
      const auto value = application_->value_of("Joint" + std::to_string(joint), "Position");
      all.push_back(*static_cast<const double*>(value.value().data()));
    }
    return all;
  }
  Vector desired() {
    const auto value = application_->value_of("Generator", "nAxesDesiredPosition");
    return *static_cast<const Vector*>(value.value().data());
  }
  static double apart(const Vector& left, const Vector& right) {
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(left[i] - right[i]));
    return most;
  }
  /// Of a place from the way between two others, in the joint that is furthest.
  static double apart_from_way(const Vector& place, const Vector& begin, const Vector& end) {
    double nearest = 1e9;
    for (double share = 0.0; share <= 1.0; share += 0.1) {
      Vector on_way;
      for (std::size_t i = 0; i < 3; ++i) on_way.push_back(begin[i] + share * (end[i] - begin[i]));
      nearest = std::min(nearest, apart(place, on_way));
    }
    return nearest;
  }
  /// Of the taught places, the one from which the arm stayed furthest away.
  static double furthest(const std::vector<Vector>& taught, const std::vector<Vector>& way) {
    double furthest = 0.0;
    for (std::size_t i = 0; i < taught.size(); i += 5) {
      double nearest = 1e9;
      for (std::size_t k = 1; k < way.size(); ++k) {
        if (apart(taught[i], way[k]) > 0.1) continue;
        nearest = std::min(nearest, apart_from_way(taught[i], way[k - 1], way[k]));
      }
      furthest = std::max(furthest, nearest);
    }
    return furthest;
  }

  std::vector<Vector> places;  ///< where it was
  std::vector<Vector> asked;   ///< where it was to be

 private:
  const std::string folder_ = ::testing::TempDir() + "own_robot_taught";
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

TEST_F(TaughtArm, PlaysWithinAHundredthOfARadianFromAnywhereAtEverySpeed) {
  auto recording = begin("Teacher", "record", {types::Value::of(Name("lift"))});
  ASSERT_EQ(move_to({0.4, 0.5, -0.4}), "");
  std::vector<Vector> taught = places;
  ASSERT_EQ(move_to({-0.2, 0.2, 0.3}), "");
  taught.insert(taught.end(), places.begin(), places.end());
  ASSERT_EQ(run("Teacher", "finish", {}), "");
  ASSERT_EQ(recording.stage(), CommandStage::kDone);
  for (const double speed : {1.0, 0.1, 3.0}) {
    ASSERT_EQ(move_to({1.0, -1.0, 1.0}), "") << speed;
    EXPECT_EQ(play(speed), "") << speed;
    EXPECT_LT(furthest(taught, asked), 0.005) << speed;
    // At three times the speed its PIDs, which know no dynamics, follow less exactly.
    EXPECT_LT(furthest(taught, places), speed > 1.0 ? 0.03 : 0.01) << speed;
  }
}

TEST_F(TaughtArm, AnUnknownMotionIsRefusedAndNothingMoves) {
  const Vector there = desired();
  EXPECT_EQ(refusal_to_play(), "unknown motion 'lift'");
  EXPECT_EQ(desired(), there);
}

}  // namespace
}  // namespace armature
