// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operators_word.hpp"

#include <gtest/gtest.h>

#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using namespace std::chrono_literals;
using types::Value;

class Arm : public Component {
 public:
  using Component::Component;
  OperatorsWord at_home{this, "at_home", "the operator has put it at home"};
};

class TheOperatorsWord : public testing::Test {
 protected:
  TheOperatorsWord() : thread_(arm_) { thread_.context.supervisor = &supervisor_; }
  void say(bool what = true) {
    const auto said = arm_.at_home.set(Value::of(what));
    EXPECT_TRUE(said) << said.error();
  }
  Arm arm_{"Arm"};
  TestThread thread_;
  TestSupervisor supervisor_;
};

TEST_F(TheOperatorsWord, IsNotSaidUntilSomebodySaysIt) {
  EXPECT_FALSE(arm_.at_home.said());
  EXPECT_FALSE(arm_.at_home.take());
  EXPECT_TRUE(arm_.at_home.is_by_operator());
  EXPECT_FALSE(arm_.at_home.persistent()) << "no file keeps it";
}

TEST_F(TheOperatorsWord, CountsOnce) {
  thread_.cycle(5s);
  say();
  EXPECT_EQ(arm_.at_home.said_at(), base::Time{} + 5s);
  EXPECT_TRUE(arm_.at_home.take());
  EXPECT_FALSE(arm_.at_home.take());
  EXPECT_FALSE(arm_.at_home());
}

TEST_F(TheOperatorsWord, IsVoidWhenItIsWithdrawnTakenBackOrOld) {
  say();
  arm_.at_home.withdraw();
  EXPECT_FALSE(arm_.at_home.said());
  say();
  say(false);
  EXPECT_FALSE(arm_.at_home.take());
  say();
  thread_.cycle(OperatorsWord::kLasts);
  EXPECT_TRUE(arm_.at_home.said());
  thread_.cycle(1ms);
  EXPECT_FALSE(arm_.at_home.take());
}

TEST_F(TheOperatorsWord, IsSaidWhileItsComponentRuns) {
  start(arm_);
  say();
  EXPECT_TRUE(arm_.at_home.take());
}

TEST(TheOperatorsWordBeforeARun, CountsForTheFirstWhoAsksWhateverTheClockSays) {
  Arm arm("Arm");
  ASSERT_TRUE(arm.at_home.set(Value::of(true)));
  TestThread thread(arm);
  thread.cycle(10h);
  EXPECT_TRUE(arm.at_home.take());
  EXPECT_FALSE(arm.at_home.take());
}

}  // namespace
}  // namespace armature::component
