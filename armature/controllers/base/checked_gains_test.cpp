// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/checked_gains.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using component::Component;
using ::testing::HasSubstr;
using types::Value;

class Notes final : public component::Check {
 public:
  void error(std::string message, std::string /*hint*/) override { said = "error: " + message; }
  void warning(std::string message, std::string /*hint*/) override { said = "warning: " + message; }
  void drives_hardware(std::string /*bus*/) override {}
  const std::vector<Component*>& components() const override { return none; }
  std::vector<const Component*> peers() const override { return {}; }
  std::vector<const component::OutputPortBase*> writers_of(
      const component::InputPortBase& /*input*/) const override {
    return {};
  }
  std::vector<const component::InputPortBase*> readers_of(
      const component::OutputPortBase& /*output*/) const override {
    return {};
  }
  bool delayed(const component::OutputPortBase& /*writer*/,
               const component::InputPortBase& /*reader*/) const override {
    return false;
  }
  const component::OperationBase* target_of(
      const component::OperationCallerBase& /*caller*/) const override {
    return nullptr;
  }
  const component::EventBase* source_of(
      const component::EventHandlerBase& /*handler*/) const override {
    return nullptr;
  }

  std::string said;
  std::vector<Component*> none;

 private:
  std::any& answer(const void* /*about*/, std::type_index /*type*/) const override {
    return answer_;
  }

  mutable std::any answer_;
};

/// Its gain is wrong above 10 times the period in milliseconds.
class Controller : public Component {
 public:
  using Component::Component;
  component::Property<double> gain{this, "Gain", 5.0, "of it"};
  std::vector<DrivenJoint> joints{DrivenJoint{}};
  CheckedGains checked{
      this, [this](const component::Check&) { return joints; },
      [this](const std::vector<DrivenJoint>&, double period_s, const CheckedGains::Wanted& wanted) {
        return wanted.value_of(gain) > 1e4 * period_s ? std::string("it shakes") : std::string();
      },
      gain};
};

class CheckedGainsTest : public ::testing::Test {
 protected:
  CheckedGainsTest() { component::Host::set_pace(controller, {.period = 1ms, .owner = &sampler}); }
  std::string said() {
    Notes notes;
    controller.checked.check(notes);
    return notes.said;
  }

  Component sampler{"Sampler"};
  Component other{"Other"};
  Controller controller{"Controller"};
};

TEST_F(CheckedGainsTest, AreJudgedWithThePeriodOfThePlan) {
  EXPECT_EQ(said(), "");
  ASSERT_TRUE(controller.gain.set(Value::of(10.0)));
  component::Host::set_pace(controller, {.period = 500us, .owner = &sampler});
  EXPECT_EQ(said(), "error: it shakes");
}

TEST_F(CheckedGainsTest, AreJudgedAtEachChangeAfterTheCheck) {
  EXPECT_TRUE(controller.gain.set(Value::of(1e9))) << "nobody checked it yet";
  ASSERT_TRUE(controller.gain.set(Value::of(1.0)));
  EXPECT_EQ(said(), "");
  const auto refused = controller.gain.set(Value::of(11.0));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("cannot be 11: it shakes"));
  EXPECT_EQ(controller.gain.get(), 1.0);
  EXPECT_TRUE(controller.gain.set(Value::of(9.0)));
}

TEST_F(CheckedGainsTest, WithTwoPeriodsAreRefusedAndWithoutOneWarnedOf) {
  component::Host::set_pace(
      controller, {.period = 1ms, .owner = &sampler, .other = 2ms, .other_owner = &other});
  EXPECT_THAT(said(),
              HasSubstr("error: its gains cannot be checked: 'Sampler' and 'Other' run it"));
  component::Host::set_pace(controller, {});
  EXPECT_EQ(said(), "warning: its gains are not checked: no periodic component runs it");
}

TEST_F(CheckedGainsTest, OfNoJointThatIsKnownAreNotJudged) {
  controller.joints.clear();
  ASSERT_TRUE(controller.gain.set(Value::of(1e9)));
  EXPECT_EQ(said(), "");
}

}  // namespace
}  // namespace armature::controllers
