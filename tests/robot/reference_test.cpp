// SPDX-License-Identifier: Apache-2.0
// The operator's Reference before a generator, as deployments connect them.
#include "armature/controllers/reference/reference.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "tests/robot/fake_joint.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;
using Vector = std::vector<double>;

/// The cycle of two joints with a Reference, in simulated time.
class Robot {
 public:
  explicit Robot(const std::string& activity = "{triggered: true, scheduler: other}") {
    deploy::DeploymentOptions options;
    options.library_folders = {LIBRARIES};
    options.models = [](component::Registry& models) {
      models.add<FakeJoint>("FakeJoint", "a joint without hardware");
    };
    const std::string text =
        "include: cycle.yaml\ncomponents:\n  Reference: {model: Reference, "
        "activity: " +
        activity +
        ", peers: [Generator], properties: {joints: 2}}\nconnections:\n  - "
        "BridgeRef.nAxesSensorPosition -> Reference.nAxesSensorPosition\n";
    deployment_ = deploy::parse_deployment(text, DEPLOYMENTS "/with_reference.yaml", options);
    EXPECT_TRUE(deployment_.ok()) << deployment_.diagnostics.to_text();
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    const auto started = application_->start();
    EXPECT_TRUE(started.ok()) << started.to_text();
  }

  void run_for(base::Duration duration) { application_->run_for(duration); }
  Vector vector(const char* component, const char* item) {
    const auto value = application_->value_of(component, item);
    EXPECT_TRUE(value) << value.error();
    return *static_cast<const Vector*>(value.value().data());
  }
  template <typename T>
  void set(const char* property, const T& value) {
    const auto set = application_->set_property("Reference", property, types::Value::of(value));
    EXPECT_TRUE(set) << set.error();
  }
  base::Result<component::CommandHandle> begin() {
    return application_->begin("Reference", "moveToRefOperation", {});
  }
  component::CommandHandle begin_accepted() {
    auto handle = begin();
    EXPECT_TRUE(handle) << handle.error();
    return std::move(handle).value();
  }
  exec::Application& application() { return *application_; }

 private:
  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

TEST(Reference, StartsAsMeasuredAndMovesNothingUntilItIsAsked) {
  Robot robot;
  robot.run_for(105ms);
  EXPECT_THAT(robot.vector("Reference", "jointPosition"),
              Pointwise(DoubleNear(1e-12), {0.02, 0.04}));
  robot.set("jointPosition", Vector{0.3, 0.4});
  robot.run_for(500ms);
  EXPECT_THAT(robot.vector("Generator", "nAxesDesiredPosition"),
              Pointwise(DoubleNear(1e-12), {0.02, 0.04}));
}

TEST(Reference, MovesTheJointsInItsTimeAndIsDoneWithTheMotion) {
  Robot robot;
  robot.run_for(105ms);
  robot.set("jointPosition", Vector{0.3, 0.4});
  robot.set("moveTime", 2.0);
  auto motion = robot.begin_accepted();
  robot.run_for(1s);
  EXPECT_EQ(motion.stage(), CommandStage::kAccepted);
  EXPECT_NEAR(motion.progress(), 0.5, 0.02);
  EXPECT_THAT(robot.vector("Generator", "nAxesDesiredPosition"),
              Pointwise(DoubleNear(0.01), {0.16, 0.22}));
  robot.run_for(1100ms);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_THAT(robot.vector("Generator", "nAxesDesiredPosition"),
              Pointwise(DoubleNear(1e-12), {0.3, 0.4}));
}

TEST(Reference, TakesFiveSecondsIfNobodySaysOtherwise) {
  Robot robot;
  robot.run_for(105ms);
  robot.set("jointPosition", Vector{0.3, 0.4});
  auto motion = robot.begin_accepted();
  robot.run_for(4900ms);
  EXPECT_EQ(motion.stage(), CommandStage::kAccepted);
  robot.run_for(200ms);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
}

TEST(Reference, FailsWithTheReasonOfTheGenerator) {
  Robot robot;
  robot.run_for(105ms);
  robot.set("jointPosition", Vector{0.3, 40.0});
  auto motion = robot.begin_accepted();
  robot.run_for(50ms);
  EXPECT_EQ(motion.stage(), CommandStage::kFailed);
  EXPECT_THAT(std::string(motion.reason()),
              HasSubstr("axis 2: a target is outside the limits of its axis: 40"));
  robot.set("jointPosition", Vector{0.3});
  auto other = robot.begin_accepted();
  robot.run_for(50ms);
  EXPECT_THAT(std::string(other.reason()), HasSubstr("expected 2, found 1"));
}

TEST(Reference, ToCancelItIsASmoothStop) {
  Robot robot;
  robot.run_for(105ms);
  robot.set("jointPosition", Vector{0.3, 0.4});
  auto motion = robot.begin_accepted();
  robot.run_for(2s);
  motion.cancel();
  robot.run_for(1s);
  EXPECT_EQ(motion.stage(), CommandStage::kCancelled);
  const Vector stopped = robot.vector("Generator", "nAxesDesiredPosition");
  EXPECT_GT(stopped[0], 0.03);
  EXPECT_LT(stopped[0], 0.29);
  robot.run_for(1s);
  EXPECT_EQ(robot.vector("Generator", "nAxesDesiredPosition"), stopped);
}

TEST(Reference, AnotherStartIsAsMeasuredAgain) {
  Robot robot;
  robot.run_for(105ms);
  robot.set("jointPosition", Vector{0.3, 0.4});
  ASSERT_TRUE(robot.application().stop_component("Reference"));
  ASSERT_TRUE(robot.application().start_component("Reference"));
  robot.run_for(50ms);
  EXPECT_THAT(robot.vector("Reference", "jointPosition"),
              Pointwise(DoubleNear(1e-9), {0.02, 0.04}));
}

}  // namespace
}  // namespace armature
