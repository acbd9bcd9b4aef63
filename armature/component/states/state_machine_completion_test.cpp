// SPDX-License-Identifier: Apache-2.0
// Triggers raised by actions, by operations and by events; exceptions and stops in the middle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_chassis.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

// --- run to completion ---------------------------------------------------------------------------

TEST_F(Machine, WhatAnActionRaisesIsHandledAfterThePresentTransition) {
  TriggerStatus inner = TriggerStatus::kIgnored;
  chassis_.then = [&](const std::string& action) {
    if (action == "+Moving") inner = chassis_.halt.raise();
  };
  EXPECT_EQ(chassis_.drive.raise(), TriggerStatus::kTaken);
  EXPECT_EQ(inner, TriggerStatus::kQueued);
  EXPECT_EQ(path(), "Idle");
  EXPECT_THAT(chassis_.take_log(), ElementsAre("-Idle", "release", "+Moving", "+Accelerating",
                                               "-Accelerating", "-Moving", "+Idle"));
}

TEST_F(Machine, WhatSeveralActionsRaiseIsHandledInOrder) {
  chassis_.then = [&](const std::string& action) {
    if (action != "release") return;
    EXPECT_EQ(chassis_.bumped.raise(), RaiseStatus::kNobodyListens);
    EXPECT_EQ(chassis_.repair.raise(), TriggerStatus::kQueued);
    EXPECT_EQ(chassis_.ping.raise(), TriggerStatus::kQueued);
  };
  chassis_.drive.raise();
  EXPECT_EQ(path(), "Moving/Cruising");
  EXPECT_EQ(chassis_.log.back(), "outer pong");
}

TEST_F(Machine, WhatADuringActionRaisesIsHandledInTheSameStep) {
  chassis_.drive.raise();
  chassis_.log.clear();
  chassis_.then = [&](const std::string& action) {
    if (action == "Moving") chassis_.halt.raise();
  };
  EXPECT_THAT(step(),
              ElementsAre("Moving", "Accelerating", "-Accelerating", "-Moving", "+Idle", "update"));
}

TEST_F(Machine, WhatAnInitialEntryActionRaisesIsHandledOnceTheMachineIsThere) {
  Chassis other("other");
  thread_.add(other);
  other.then = [&](const std::string& action) {
    if (action == "+Idle") other.drive.raise();
  };
  start(other);
  EXPECT_EQ(other.mode.path(), "Moving/Accelerating");
}

TEST_F(Machine, AFullQueueIsAnAnswerAndCounted) {
  std::vector<TriggerStatus> answers;
  chassis_.then = [&](const std::string& action) {
    if (action != "release") return;
    for (std::size_t i = 0; i <= StateMachine::kQueue; ++i)
      answers.push_back(chassis_.ping.raise());
  };
  chassis_.drive.raise();
  ASSERT_EQ(answers.size(), StateMachine::kQueue + 1);
  EXPECT_EQ(answers[StateMachine::kQueue - 1], TriggerStatus::kQueued);
  EXPECT_EQ(answers[StateMachine::kQueue], TriggerStatus::kQueueFull);
  EXPECT_EQ(chassis_.mode.triggers_refused(), 1u);
  EXPECT_EQ(std::count(chassis_.log.begin(), chassis_.log.end(), "pong"),
            static_cast<std::ptrdiff_t>(StateMachine::kQueue));
}

TEST_F(Machine, ActionsThatCauseEachOtherWithoutEndAreAFaultNotAHang) {
  chassis_.then = [&](const std::string& action) {
    if (action == "+Moving") chassis_.halt.raise();
    if (action == "+Idle") chassis_.drive.raise();
  };
  chassis_.drive.raise();
  EXPECT_EQ(chassis_.state(), State::kException);
  EXPECT_EQ(chassis_.reason(), "state machine 'mode' does not come to rest");
  EXPECT_EQ(path(), "");
}

// --- operations and events as triggers -----------------------------------------------------------

class Superior : public Component {
 public:
  using Component::Component;
  OperationCaller<bool()> drive{this, "drive", "starts the chassis"};
};

TEST_F(Machine, AnOperationTriggersAndSaysWhetherTheMachineReacted) {
  Superior superior("superior");
  thread_.add(superior);
  ASSERT_EQ(interface_of(chassis_).operations.front()->name(), "drive");
  ASSERT_TRUE(interface_of(chassis_).operations.front()->runs_in_own_thread());
  face(superior.drive).connect(*interface_of(chassis_).operations.front());
  EXPECT_TRUE(superior.drive().value);
  EXPECT_EQ(path(), "Moving/Accelerating");
  EXPECT_FALSE(superior.drive().value) << "it moves already";
}

TEST_F(Machine, AnOperationFromAnotherThreadTriggersInItsOwn) {
  Superior superior("superior");
  TestThread other(superior);
  thread_.context.live = true;
  face(superior.drive).connect(*interface_of(chassis_).operations.front());
  SendHandle<bool> handle = superior.drive.send();
  EXPECT_EQ(path(), "Idle");
  thread_.deliver();
  EXPECT_TRUE(handle.collect().value);
  EXPECT_EQ(path(), "Moving/Accelerating");
}

class Motor : public Component {
 public:
  using Component::Component;
  Event<double> overheated{this, "overheated", "too hot", {"temperature [degC]"}};
};

class Guarded : public Component {
 public:
  using Component::Component;
  EventTrigger<double> overheated{this, "overheated", "of the motor"};
  StateMachine mode{this, "mode", "reacts to heat",
                    in_state("Cool", on(overheated, guarded_by<&Guarded::is_serious>, to("Hot"))),
                    in_state("Hot")};

 private:
  bool is_serious() const { return std::get<0>(overheated.arguments()) > 80.0; }
};

TEST(MachineEvents, APeersEventTriggersAndGuardsSeeWhatCameWithIt) {
  Motor motor("motor");
  Guarded guarded("guarded");
  TestThread one(motor);
  TestThread other(guarded);
  ASSERT_EQ(interface_of(guarded).handlers.size(), 1u) << "bound by name, like any handler";
  face(motor.overheated).subscribe(*interface_of(guarded).handlers.front());
  start(motor, guarded);
  motor.overheated.raise(75.0);
  other.deliver();
  EXPECT_EQ(guarded.mode.path(), "Cool");
  motor.overheated.raise(85.0);
  other.deliver();
  EXPECT_EQ(guarded.mode.path(), "Hot");
}

TEST(MachineEvents, SeveralMachinesOfAComponentShareATrigger) {
  class Two : public Component {
   public:
    using Component::Component;
    Trigger go{"go"};
    StateMachine left{this, "left", "", in_state("A", on(go, to("B"))), in_state("B")};
    StateMachine right{this, "right", "", in_state("A", on(go, to("B"))),
                       in_state("B", on(go, to("A")))};
  };
  Two two("two");
  TestThread thread(two);
  start(two);
  EXPECT_EQ(two.go.raise(), TriggerStatus::kTaken);
  EXPECT_EQ(two.go.raise(), TriggerStatus::kTaken) << "one of them took it";
  EXPECT_EQ(two.left.path(), "B");
  EXPECT_EQ(two.right.path(), "A");
}

// --- exceptions and interruptions ----------------------------------------------------------------

struct Place {
  const char* action;
  std::vector<std::string> left;  ///< exit actions that still run
  friend void PrintTo(const Place& place, std::ostream* out) { *out << place.action; }
};

class MachineException : public Machine, public testing::WithParamInterface<Place> {};

TEST_P(MachineException, FaultsTheComponentAndLeavesWhatWasEntered) {
  const Place& place = GetParam();
  chassis_.then = [&](const std::string& action) {
    if (action == place.action) throw std::runtime_error("in " + action);
  };
  Host::run(chassis_, thread_.context, [&] { chassis_.drive.raise(); });
  Host::update(chassis_);
  EXPECT_EQ(chassis_.state(), State::kException);
  EXPECT_EQ(chassis_.reason(), "exception: in " + std::string(place.action));
  EXPECT_EQ(path(), "");
  const auto at = std::find(chassis_.log.begin(), chassis_.log.end(), place.action);
  ASSERT_NE(at, chassis_.log.end());
  EXPECT_EQ(std::vector<std::string>(at + 1, chassis_.log.end()), place.left);
  chassis_.then = nullptr;
  ASSERT_TRUE(Host::reset(chassis_));
  ASSERT_TRUE(Host::start(chassis_));
  EXPECT_EQ(path(), "Idle") << "it can begin again";
  EXPECT_EQ(chassis_.drive.raise(), TriggerStatus::kTaken);
}

INSTANTIATE_TEST_SUITE_P(Places, MachineException,
                         testing::Values(Place{"-Idle", {}}, Place{"release", {}},
                                         Place{"+Moving", {}}, Place{"+Accelerating", {"-Moving"}},
                                         Place{"Moving", {"-Accelerating", "-Moving"}},
                                         Place{"Accelerating", {"-Accelerating", "-Moving"}}));

TEST_F(Machine, AnExceptionInAnExitActionWhileStoppingDoesNotSkipTheOuterOnes) {
  chassis_.drive.raise();
  chassis_.log.clear();
  chassis_.then = [](const std::string& action) {
    if (action == "-Accelerating") throw 42;
  };
  Host::stop(chassis_);
  EXPECT_THAT(chassis_.take_log(), ElementsAre("-Accelerating", "-Moving"));
  EXPECT_EQ(chassis_.state(), State::kException);
  EXPECT_EQ(path(), "");
}

TEST_F(Machine, AnExceptionInTheInitialEntryIsARefusalToStart) {
  Chassis other("other");
  thread_.add(other);
  other.then = [](const std::string&) { throw std::runtime_error("no brake"); };
  ASSERT_TRUE(Host::configure(other));
  const Outcome outcome = Host::start(other);
  EXPECT_EQ(outcome.reason(), "exception: no brake");
  EXPECT_EQ(other.state(), State::kException);
}

TEST_F(Machine, AnActionMayStopItsComponentAndNothingOfTheTransitionGoesOn) {
  chassis_.then = [&](const std::string& action) {
    if (action == "+Moving") Host::stop(chassis_);
  };
  chassis_.drive.raise();
  EXPECT_EQ(chassis_.state(), State::kStopped);
  EXPECT_EQ(path(), "");
  EXPECT_THAT(chassis_.take_log(), ElementsAre("-Idle", "release", "+Moving"));
  chassis_.then = nullptr;
  ASSERT_TRUE(Host::start(chassis_));
  EXPECT_EQ(path(), "Idle");
}

TEST_F(Machine, AFaultInADuringActionIsTheEndOfTheStep) {
  chassis_.drive.raise();
  chassis_.log.clear();
  chassis_.then = [&](const std::string& action) {
    if (action == "Moving") chassis_.fault("stuck");
  };
  EXPECT_THAT(step(), ElementsAre("Moving", "-Accelerating", "-Moving"));
  EXPECT_THAT(supervisor_.faulted, ElementsAre("chassis"));
}

}  // namespace
}  // namespace armature::component
