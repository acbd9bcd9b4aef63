// SPDX-License-Identifier: Apache-2.0
// Commands that a tool begins and follows, and acts of the operator.
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using component::CommandHandle;
using component::CommandStage;
using types::Value;

/// Moves one step in each cycle until it is there.
class Axis : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome begin_move(double target) {
    if (target > 1e9) return component::refused("the target is outside the axis");
    target_ = target;
    return component::accepted();
  }
  void on_update() override {
    if (position_ < target_) position_ += 1.0;
    move_.report(position_ / target_);
    position_port_.write(position_);
  }
  bool arrived() { return position_ >= target_; }
  void brake() { target_ = position_; }
  double where() { return position_; }

  component::OutputPort<double> position_port_{this, "Position", "where it is", "m"};
  component::Command<double> move_{this,
                                   "move",
                                   component::serve<&Axis::begin_move>,
                                   "goes there",
                                   component::args("target [m]"),
                                   component::done_when<&Axis::arrived>,
                                   component::cancelled_by<&Axis::brake>};
  component::Command<> arm_{this, "arm", component::serve<&Axis::begin_arm>, "lets it move",
                            component::by_operator};
  component::Operation<double()> where_{this,
                                        "where",
                                        component::serve<&Axis::where>,
                                        "where it is",
                                        component::in_own_thread,
                                        component::by_operator};

  component::OperatorsWord at_home_{this, "at_home", "the operator has put it at home"};
  component::Command<> release_{this, "release", component::serve<&Axis::begin_release>,
                                "lets it be pushed", component::in_any_state};

  component::Outcome begin_release() {
    release_.complete();
    return component::accepted();
  }
  component::Outcome begin_arm() {
    arm_.complete();
    return component::accepted();
  }

  double position_ = 0.0;
  double target_ = 0.0;
};

class Commands : public ::testing::TestWithParam<bool> {
 protected:
  Commands() { start({}); }
  void start(std::vector<Grant> grants) {
    Blueprint blueprint;
    blueprint.add<Axis>("Axis", Activity::periodic(1ms));
    ApplicationOptions options = patient(GetParam());
    options.grants = std::move(grants);
    application_.emplace(std::move(blueprint), std::move(options));
    EXPECT_EQ(application_->start().to_text(), "");
  }
  Application& application() { return *application_; }
  CommandHandle move(double target) {
    auto begun = application().begin("Axis", "move", {Value::of(target)});
    EXPECT_TRUE(begun) << begun.error();
    return std::move(begun).value();
  }
  void wait_for(const CommandHandle& handle) {
    EXPECT_EQ(application().run_until(application().now() + 60s, [&] { return handle.ended(); }),
              RunEnd::kConditionMet);
  }

  std::optional<Application> application_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, Commands, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(Commands, AToolFollowsTheCommandThatItBegan) {
  const CommandHandle handle = move(5.0);
  wait_for(handle);
  EXPECT_EQ(handle.stage(), CommandStage::kDone);
  EXPECT_EQ(handle.reason(), "");
  EXPECT_EQ(handle.progress(), 1.0);
}

TEST_P(Commands, AToolCancelsTheCommandThatItBegan) {
  CommandHandle handle = move(1e6);
  EXPECT_FALSE(handle.ended());
  handle.cancel();
  wait_for(handle);
  EXPECT_EQ(handle.stage(), CommandStage::kCancelled);
  EXPECT_EQ(handle.reason(), "cancelled by its sender");
}

TEST_P(Commands, ARefusalIsTheAnswer) {
  EXPECT_EQ(application().begin("Axis", "move", {Value::of(2e9)}).error(),
            "the target is outside the axis");
  EXPECT_EQ(application().begin("Axis", "move", {Value::of(1)}).error(),
            "'Axis.move' is void(double target [m]); it was called with (int32)");
  EXPECT_EQ(application().begin("Axis", "where", {}).error(),
            "'Axis.where' is an operation, not a command: call it");
  EXPECT_EQ(application().begin("Axis", "mve", {}).error(),
            "'Axis' has no operation 'mve' (did you mean 'move'?)");
  const CommandHandle handle = move(1e6);
  EXPECT_EQ(application().begin("Axis", "move", {Value::of(1.0)}).error(),
            "the previous command is still under way, and this command does not queue");
}

TEST_P(Commands, AHandleOutlivesTheApplication) {
  CommandHandle handle = move(1e6);
  CommandHandle other = std::move(handle);
  EXPECT_TRUE(application().stop().ok());
  EXPECT_EQ(other.stage(), CommandStage::kCancelled);
  application_.reset();
  EXPECT_EQ(other.stage(), CommandStage::kCancelled);
  other.cancel();
}

TEST_P(Commands, AHandleThatWasLetGoOfCancelsNothing) {
  static_cast<void>(move(5.0));
  const auto arrived = [&] {
    return *application().value_of("Axis", "Position").value().get_if<double>() >= 5.0;
  };
  EXPECT_EQ(application().run_until(application().now() + 60s, arrived), RunEnd::kConditionMet);
}

TEST_P(Commands, AScriptMayNotDoAnActOfTheOperator) {
  EXPECT_EQ(application().begin("Axis", "arm", {}, Caller::kScript).error(),
            "'Axis.arm' is an act of the operator: a script may use it only if the deployment "
            "grants it (grants: {script: [Axis.arm]})");
  EXPECT_THAT(application().call("Axis", "arm", {}, Caller::kScript).error(),
              ::testing::StartsWith("'Axis.arm' is an act of the operator"));
  EXPECT_THAT(application().call("Axis", "where", {}, Caller::kScript).error(),
              ::testing::StartsWith("'Axis.where' is an act of the operator"));
  EXPECT_TRUE(application().begin("Axis", "move", {Value::of(1.0)}, Caller::kScript));
  EXPECT_TRUE(application().begin("Axis", "arm", {}, Caller::kOperator));
}

TEST_P(Commands, AScriptMayDoWhatTheDeploymentGrants) {
  start({{Caller::kScript, "Axis", "arm"}});
  EXPECT_TRUE(application().begin("Axis", "arm", {}, Caller::kScript));
  EXPECT_FALSE(application().call("Axis", "where", {}, Caller::kScript));
}

TEST_P(Commands, AScriptSaysNoWordOfTheOperatorUnlessItIsGranted) {
  EXPECT_EQ(application().set_property("Axis", "at_home", Value::of(true), Caller::kScript).error(),
            "'Axis.at_home' is an act of the operator: a script may use it only if the deployment "
            "grants it (grants: {script: [Axis.at_home]})");
  EXPECT_FALSE(application().set_property("Axis", "at_home", Value::of(true), Caller::kRemote));
  EXPECT_TRUE(application().set_property("Axis", "at_home", Value::of(true)));
  start({{Caller::kScript, "Axis", "at_home"}});
  EXPECT_TRUE(application().set_property("Axis", "at_home", Value::of(true), Caller::kScript));
}

TEST_P(Commands, WhatIsServedInAnyStateIsServedWhileItsComponentDoesNotRun) {
  ASSERT_TRUE(application().stop_component("Axis"));
  EXPECT_EQ(application().begin("Axis", "move", {Value::of(1.0)}).error(),
            "the component is not running");
  const auto released = application().begin("Axis", "release", {});
  ASSERT_TRUE(released) << released.error();
  EXPECT_EQ(released.value().stage(), CommandStage::kDone);
  ASSERT_TRUE(application().clean_up_component("Axis"));
  EXPECT_TRUE(application().begin("Axis", "release", {}));
}

TEST(SimulatedTime, StopsAtTheInstantAtWhichTheConditionBecameTrue) {
  Blueprint blueprint;
  blueprint.add<Axis>("Axis", Activity::periodic(10ms));
  Application application(std::move(blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  const base::Time begin = application.now();
  const auto begun = application.begin("Axis", "move", {Value::of(3.0)});
  ASSERT_TRUE(begun) << begun.error();
  const auto done = [&] { return begun.value().ended(); };
  EXPECT_EQ(application.run_until(begin + 1s, done), RunEnd::kConditionMet);
  EXPECT_EQ(application.now() - begin, 30ms) << "cycles at 10, 20 and 30 ms";
  EXPECT_EQ(application.run_until(begin + 35ms, [] { return false; }), RunEnd::kTimeUp);
  EXPECT_EQ(application.now() - begin, 35ms);
}

}  // namespace
}  // namespace armature::exec
