// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

class Axis : public Component {
 public:
  using Component::Component;
  Command<double> move_to{this,
                          "moveTo",
                          serve<&Axis::begin_move>,
                          "moves",
                          args("position [rad]"),
                          done_when<&Axis::at_rest>,
                          cancelled_by<&Axis::brake>};

  std::vector<double> targets;
  bool resting = false;
  int brakes = 0;
  std::function<void()> on_begin;
  std::function<void()> on_brake;

 private:
  Outcome begin_move(double target) {
    if (target > 10.0) return refused("beyond the limit of the joint");
    targets.push_back(target);
    if (on_begin) on_begin();
    return accepted();
  }
  bool at_rest() { return resting; }
  void brake() {
    ++brakes;
    if (on_brake) on_brake();
  }
};

class Planner : public Component {
 public:
  using Component::Component;
  CommandCaller<double> move_to{this, "moveTo", "moves an axis", outstanding(2)};
};

class Commands : public testing::Test {
 protected:
  Commands() : superior_(planner_), subordinate_(axis_) {
    subordinate_.context.live = true;
    face(planner_.move_to).connect(face(axis_.move_to));
    start(planner_, axis_);
  }
  CommandHandle send(double target) {
    CommandHandle handle = planner_.move_to.send(target);
    subordinate_.deliver();
    return handle;
  }
  Outcome begin(double target) {
    const std::array<const void*, 1> places{&target};
    return face(axis_.move_to).begin_from(nullptr, places.data());
  }
  Axis axis_{"axis"};
  Planner planner_{"planner"};
  TestThread superior_{"superior"};
  TestThread subordinate_{"subordinate"};
};

TEST_F(Commands, AreQueuedThenAcceptedThenDone) {
  CommandHandle handle = planner_.move_to.send(1.0);
  EXPECT_TRUE(handle.sent());
  EXPECT_EQ(handle.send_status(), CallStatus::kDone);
  EXPECT_EQ(handle.stage(), CommandStage::kQueued);
  EXPECT_FALSE(handle.ended());
  subordinate_.deliver();
  EXPECT_EQ(handle.stage(), CommandStage::kAccepted);
  EXPECT_TRUE(axis_.move_to.active());
  Host::update(axis_);
  EXPECT_EQ(handle.stage(), CommandStage::kAccepted);
  axis_.resting = true;
  Host::update(axis_);
  EXPECT_EQ(handle.stage(), CommandStage::kDone);
  EXPECT_TRUE(handle.ended());
  EXPECT_EQ(handle.reason(), "");
  EXPECT_FALSE(axis_.move_to.active());
  EXPECT_EQ(axis_.brakes, 0);
}

TEST_F(Commands, AreRefusedWithAReasonAndThenNothingIsUnderWay) {
  const CommandHandle handle = send(11.0);
  EXPECT_EQ(handle.stage(), CommandStage::kRefused);
  EXPECT_EQ(handle.reason(), "beyond the limit of the joint");
  EXPECT_FALSE(axis_.move_to.active());
  EXPECT_EQ(send(1.0).stage(), CommandStage::kAccepted);
}

TEST_F(Commands, OneAtATime) {
  const CommandHandle first = send(1.0);
  const CommandHandle second = send(2.0);
  EXPECT_EQ(second.stage(), CommandStage::kRefused);
  EXPECT_EQ(second.reason(),
            "the previous command is still under way, and this command does not queue");
  EXPECT_EQ(first.stage(), CommandStage::kAccepted);
  EXPECT_THAT(axis_.targets, ElementsAre(1.0));
}

TEST_F(Commands, AreRefusedByWhatDoesNotRun) {
  Host::stop(axis_);
  const CommandHandle handle = send(1.0);
  EXPECT_EQ(handle.stage(), CommandStage::kRefused);
  EXPECT_EQ(handle.reason(), "the component is not running");
}

TEST_F(Commands, ReportProgressAndTheirEndThemselves) {
  const CommandHandle handle = send(1.0);
  EXPECT_EQ(handle.progress(), 0.0);
  axis_.move_to.report(0.25);
  EXPECT_EQ(handle.progress(), 0.25);
  axis_.move_to.fail("the motor stalled");
  EXPECT_EQ(handle.stage(), CommandStage::kFailed);
  EXPECT_EQ(handle.reason(), "the motor stalled");
  axis_.move_to.report(0.5);
  axis_.move_to.complete();
  EXPECT_EQ(handle.stage(), CommandStage::kFailed) << "an end is an end";
  EXPECT_EQ(handle.progress(), 0.25);
}

TEST_F(Commands, MayBeDoneWhileTheyBegin) {
  axis_.on_begin = [this] { axis_.move_to.complete(); };
  EXPECT_EQ(send(0.0).stage(), CommandStage::kDone);
  EXPECT_FALSE(axis_.move_to.active());
  axis_.on_begin = [this] { axis_.move_to.fail("no power"); };
  const CommandHandle failed = send(0.0);
  EXPECT_EQ(failed.stage(), CommandStage::kFailed);
  EXPECT_EQ(failed.reason(), "no power");
}

TEST_F(Commands, AreCancelledByTheirSenderWithoutAnUpdate) {
  CommandHandle handle = send(1.0);
  handle.cancel();
  EXPECT_EQ(handle.stage(), CommandStage::kAccepted);
  subordinate_.deliver();
  EXPECT_EQ(handle.stage(), CommandStage::kCancelled);
  EXPECT_EQ(handle.reason(), "cancelled by its sender");
  EXPECT_EQ(axis_.brakes, 1);
}

TEST_F(Commands, CancelledBeforeTheyBeginTheyNeverDo) {
  CommandHandle handle = planner_.move_to.send(1.0);
  handle.cancel();
  handle.cancel();
  subordinate_.deliver();
  EXPECT_EQ(handle.stage(), CommandStage::kCancelled);
  EXPECT_EQ(handle.reason(), "cancelled before it began");
  EXPECT_THAT(axis_.targets, ElementsAre());
  EXPECT_EQ(axis_.brakes, 0);
}

TEST_F(Commands, CancellingOneThatEndedDoesNotTouchTheNext) {
  CommandHandle first = send(1.0);
  axis_.move_to.complete();
  const CommandHandle second = send(2.0);
  first.cancel();
  subordinate_.deliver();
  EXPECT_EQ(first.stage(), CommandStage::kDone);
  EXPECT_EQ(second.stage(), CommandStage::kAccepted);
}

TEST_F(Commands, StoppingTheComponentCancelsThem) {
  const CommandHandle handle = send(1.0);
  Host::stop(axis_);
  EXPECT_EQ(handle.stage(), CommandStage::kCancelled);
  EXPECT_EQ(handle.reason(), "the component was stopped");
  EXPECT_EQ(axis_.brakes, 1);
}

TEST_F(Commands, AFaultCancelsThemWithItsReason) {
  const CommandHandle handle = send(1.0);
  axis_.fault("encoder lost");
  EXPECT_EQ(handle.stage(), CommandStage::kCancelled);
  EXPECT_EQ(handle.reason(), "encoder lost");
}

TEST_F(Commands, WhatIsCancelledByAStopCannotBeginAgainMeanwhile) {
  const CommandHandle handle = send(1.0);
  axis_.on_brake = [this] {
    const Outcome again = begin(2.0);
    EXPECT_EQ(again.reason(), "the component is not running");
  };
  Host::stop(axis_);
  EXPECT_FALSE(axis_.move_to.active());
  ASSERT_TRUE(Host::start(axis_));
  EXPECT_EQ(send(3.0).stage(), CommandStage::kAccepted);
}

TEST_F(Commands, AnExceptionWhileBeginningRefusesAndFaults) {
  axis_.on_begin = [] { throw std::runtime_error("no such frame"); };
  const CommandHandle handle = send(1.0);
  EXPECT_EQ(handle.stage(), CommandStage::kRefused);
  EXPECT_EQ(handle.reason(), "exception: no such frame");
  EXPECT_EQ(axis_.state(), State::kException);
  EXPECT_EQ(axis_.brakes, 0) << "nothing was under way";
}

TEST_F(Commands, AnExceptionWhileCancellingStillEndsThem) {
  CommandHandle handle = send(1.0);
  axis_.on_brake = [] { throw 42; };
  handle.cancel();
  subordinate_.deliver();
  EXPECT_EQ(handle.stage(), CommandStage::kCancelled);
  EXPECT_EQ(axis_.state(), State::kException);
}

TEST_F(Commands, MoreThanTheDeclaredNumberSentIsAnAnswerAndCounted) {
  const CommandHandle first = planner_.move_to.send(1.0);
  const CommandHandle second = planner_.move_to.send(2.0);
  const CommandHandle third = planner_.move_to.send(3.0);
  EXPECT_FALSE(third.sent());
  EXPECT_EQ(third.send_status(), CallStatus::kQueueFull);
  EXPECT_EQ(third.stage(), CommandStage::kRefused);
  EXPECT_EQ(third.reason(), "queue full");
  EXPECT_TRUE(third.ended());
  EXPECT_EQ(face(planner_.move_to).refused(), 1u);
  subordinate_.deliver();
}

TEST_F(Commands, OfAComponentThatGoesAreOver) {
  auto axis = std::make_unique<Axis>("short-lived");
  subordinate_.add(*axis);
  start(*axis);
  face(planner_.move_to).disconnect();
  face(planner_.move_to).connect(face(axis->move_to));
  const CommandHandle handle = send(1.0);
  EXPECT_EQ(handle.stage(), CommandStage::kAccepted);
  axis.reset();
  EXPECT_EQ(handle.stage(), CommandStage::kCancelled);
  EXPECT_EQ(handle.reason(), "its component has been destroyed");
}

TEST_F(Commands, TicketsAreUsedAgainAndBeginAfresh) {
  for (int i = 0; i < 10; ++i) {
    CommandHandle handle = send(static_cast<double>(i));
    EXPECT_EQ(handle.stage(), CommandStage::kAccepted);
    EXPECT_EQ(handle.progress(), 0.0);
    EXPECT_EQ(handle.reason(), "");
    axis_.move_to.report(0.5);
    handle.cancel();
    subordinate_.deliver();
  }
  EXPECT_EQ(axis_.brakes, 10);
}

TEST_F(Commands, LettingGoOfAHandleDoesNotCancel) {
  static_cast<void>(send(1.0));
  subordinate_.deliver();
  EXPECT_TRUE(axis_.move_to.active());
}

TEST_F(Commands, AHandleMayOutliveTheConnection) {
  CommandHandle handle = send(1.0);
  face(planner_.move_to).disconnect();
  EXPECT_EQ(planner_.move_to.send(2.0).send_status(), CallStatus::kNotConnected);
  axis_.move_to.complete();
  EXPECT_EQ(handle.stage(), CommandStage::kDone);
}

TEST_F(Commands, ToolsBeginThemAndAreToldWhyNot) {
  EXPECT_TRUE(face(axis_.move_to).invoke({types::Value::of(1.0)}));
  const auto again = face(axis_.move_to).invoke({types::Value::of(1.0)});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(),
            "the previous command is still under way, and this command does not queue");
  const auto wrong = face(axis_.move_to).invoke({types::Value::of(1)});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error(),
            "'axis.moveTo' is void(double position [rad]); it was called with (int32)");
  EXPECT_TRUE(face(axis_.move_to).is_command());
  EXPECT_TRUE(face(planner_.move_to).needs_command());
}

TEST(CommandNames, AreWords) {
  EXPECT_EQ(name_of(CommandStage::kQueued), "queued");
  EXPECT_EQ(name_of(CommandStage::kWaiting), "waiting");
  EXPECT_EQ(name_of(CommandStage::kAccepted), "under way");
  EXPECT_EQ(name_of(CommandStage::kRefused), "refused");
  EXPECT_EQ(name_of(CommandStage::kDone), "done");
  EXPECT_EQ(name_of(CommandStage::kFailed), "failed");
  EXPECT_EQ(name_of(CommandStage::kCancelled), "cancelled");
}

}  // namespace
}  // namespace armature::component
