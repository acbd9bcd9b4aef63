// SPDX-License-Identifier: Apache-2.0
// What a deployment has done before an orderly stop.
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::HasSubstr;
using types::Value;

/// Goes home one step in each cycle, unless something holds it.
class Arm : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome begin_home() {
    if (steps_ > 1000) return component::refused("home is too far away");
    if (steps_ < 0) fault("it is behind its home");
    going_ = true;
    return component::accepted();
  }
  void on_update() override {
    if (going_ && !holds_ && steps_gone_ < steps_) steps_gone_.assign(steps_gone_ + 1);
  }
  bool at_home() { return steps_gone_ == steps_; }

  component::Property<int> steps_{
      this, "steps", 5, "how far it is from home", "", component::changeable_while_running};
  component::Property<bool> holds_{
      this, "holds", false, "it does not move", "", component::changeable_while_running};
  component::Command<> home_{this, "home", component::serve<&Arm::begin_home>, "goes home",
                             component::done_when<&Arm::at_home>};
  component::Attribute<int> steps_gone_{this, "steps_gone", 0, "towards home"};
  bool going_ = false;
};

class BeforeStop : public ::testing::TestWithParam<bool> {
 protected:
  BeforeStop() {
    Blueprint blueprint;
    blueprint.add<Arm>("Left", Activity::periodic(1ms));
    blueprint.add<Arm>("Right", Activity::periodic(1ms));
    ApplicationOptions options = patient(GetParam());
    options.before_stop = {{"Left", "home"}, {"Right", "home"}};
    options.before_stop_limit = 1s;
    application_.emplace(std::move(blueprint), std::move(options));
    EXPECT_EQ(application_->start().to_text(), "");
  }
  std::string finish(RunEnd end = RunEnd::kTimeUp) {
    return application_->run_before_stop(end).to_text();
  }
  void set(const char* arm, const char* property, Value value) {
    const auto done = application_->set_property(arm, property, value);
    EXPECT_TRUE(done) << done.error();
  }
  int steps_gone(const char* arm) {
    return *application_->value_of(arm, "steps_gone").value().get_if<int>();
  }

  std::optional<Application> application_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, BeforeStop, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(BeforeStop, ItsCommandsAreDoneOneAfterTheOther) {
  EXPECT_EQ(finish(), "");
  EXPECT_EQ(steps_gone("Left"), 5);
  EXPECT_EQ(steps_gone("Right"), 5);
}

TEST_P(BeforeStop, WhatIsUnderWayIsCancelledFirst) {
  set("Left", "holds", Value::of(true));
  auto before = application_->begin("Left", "home", {});
  ASSERT_TRUE(before) << before.error();
  application_->run_for(10ms);
  ASSERT_EQ(before.value().stage(), component::CommandStage::kAccepted);
  EXPECT_THAT(finish(), HasSubstr("'Left.home' did not end within 1 s")) << "it was begun";
  EXPECT_EQ(before.value().stage(), component::CommandStage::kCancelled);
}

TEST_P(BeforeStop, NothingIsDoneAfterAFault) {
  EXPECT_EQ(finish(RunEnd::kFaulted), "");
  EXPECT_EQ(finish(RunEnd::kStoppedByReaction), "");
  EXPECT_EQ(steps_gone("Left"), 0);
}

TEST_P(BeforeStop, AFaultEndsItAndNothingFollows) {
  set("Left", "steps", Value::of(-1));
  EXPECT_THAT(finish(), HasSubstr("before the stop, 'Left.home' was ended by a fault"));
  EXPECT_EQ(steps_gone("Right"), 0);
}

TEST_P(BeforeStop, ARefusalIsToldAndTheNextFollows) {
  set("Left", "steps", Value::of(2000));
  EXPECT_THAT(finish(), HasSubstr("'Left.home' was refused: home is too far away"));
  EXPECT_EQ(steps_gone("Right"), 5);
}

TEST_P(BeforeStop, WhatDoesNotEndInTimeIsToldAndGivenUp) {
  set("Left", "holds", Value::of(true));
  EXPECT_THAT(finish(), HasSubstr("'Left.home' did not end within 1 s"));
  EXPECT_EQ(steps_gone("Right"), 5);
}

}  // namespace
}  // namespace armature::exec
