// SPDX-License-Identifier: Apache-2.0
// Commands that wait for the one under way.
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/testing/realtime_guard.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using ::testing::ElementsAre;

/// Of which two wait while one is under way; it goes to a list of places.
class Queue : public Component {
 public:
  using Component::Component;
  Command<const std::vector<double>&> visit{this,
                                            "visit",
                                            serve<&Queue::begin>,
                                            "goes there",
                                            args("places"),
                                            done_when<&Queue::there>,
                                            cancelled_by<&Queue::brake>,
                                            may_wait<&Queue::can_be>(2)};

  std::vector<double> visited;  ///< the first place of each command that began
  double forbidden = -1.0;
  bool is_there = false;
  int brakes = 0;

 private:
  Outcome begin(const std::vector<double>& places) {
    if (places.front() == forbidden) return refused("there is no way to it");
    visited.push_back(places.front());
    return accepted();
  }
  Outcome can_be(const std::vector<double>& places) const {
    return places.size() == 2 ? accepted() : refused("expected two places");
  }
  bool there() { return is_there; }
  void brake() { ++brakes; }
};

class QueuedCommands : public ::testing::Test {
 protected:
  class Sender : public Component {
   public:
    using Component::Component;
    CommandCaller<const std::vector<double>&> visit{this, "visit", "", outstanding(5)};
  };

  QueuedCommands() : superior_(sender_), subordinate_(queue_) {
    subordinate_.context.live = true;
    face(sender_.visit).connect(face(queue_.visit));
    queue_.visit.prepare({0.0, 0.0});
    start(sender_, queue_);
  }
  CommandHandle send(std::vector<double> places) {
    CommandHandle handle = sender_.visit.send(places);
    subordinate_.deliver();
    return handle;
  }
  CommandHandle send(double place) { return send({place, 0.0}); }
  void arrive() {
    queue_.is_there = true;
    Host::update(queue_);
    queue_.is_there = false;
  }

  static constexpr const char* kWaited = "it waited for a command that was not done: ";
  Queue queue_{"queue"};
  Sender sender_{"sender"};
  TestThread superior_{"superior"};
  TestThread subordinate_{"subordinate"};
};

TEST_F(QueuedCommands, BeginInTheirOrderEachWhenTheOneBeforeIsDone) {
  const CommandHandle first = send(1.0);
  const CommandHandle second = send(2.0);
  const CommandHandle third = send(3.0);
  EXPECT_EQ(first.stage(), CommandStage::kAccepted);
  EXPECT_EQ(second.stage(), CommandStage::kWaiting);
  EXPECT_EQ(third.stage(), CommandStage::kWaiting);
  EXPECT_FALSE(second.ended());
  EXPECT_EQ(queue_.visit.waiting(), 2u);
  queue_.visit.report(0.5);
  EXPECT_EQ(second.progress(), 0.0);
  Host::update(queue_);
  EXPECT_THAT(queue_.visited, ElementsAre(1.0));
  arrive();
  EXPECT_EQ(first.stage(), CommandStage::kDone);
  EXPECT_EQ(second.stage(), CommandStage::kAccepted);
  EXPECT_EQ(third.stage(), CommandStage::kWaiting);
  arrive();
  arrive();
  EXPECT_EQ(third.stage(), CommandStage::kDone);
  EXPECT_THAT(queue_.visited, ElementsAre(1.0, 2.0, 3.0));
  EXPECT_EQ(queue_.brakes, 0);
}

TEST_F(QueuedCommands, OneMoreThanMayWaitIsRefusedWithTheNumber) {
  const CommandHandle first = send(1.0), second = send(2.0), third = send(3.0), fourth = send(4.0);
  EXPECT_EQ(fourth.stage(), CommandStage::kRefused);
  EXPECT_EQ(fourth.reason(),
            "one command is under way and 2 wait, which is the most: wait until one is done");
  arrive();
  EXPECT_EQ(send(5.0).stage(), CommandStage::kWaiting) << "there is room again";
  arrive();
  arrive();
  EXPECT_THAT(queue_.visited, ElementsAre(1.0, 2.0, 3.0, 5.0));
}

TEST_F(QueuedCommands, WhatCannotBeWhereverItBeginsIsRefusedAtOnce) {
  const CommandHandle first = send(1.0);
  const CommandHandle wrong = send({2.0, 3.0, 4.0});
  EXPECT_EQ(wrong.stage(), CommandStage::kRefused);
  EXPECT_EQ(wrong.reason(), "expected two places");
  EXPECT_EQ(queue_.visit.waiting(), 0u);
  EXPECT_EQ(first.stage(), CommandStage::kAccepted);
}

TEST_F(QueuedCommands, OneThatIsRefusedWhenItsTurnComesEndsThoseBehindIt) {
  const CommandHandle first = send(1.0), second = send(2.0), third = send(3.0);
  queue_.forbidden = 2.0;
  arrive();
  EXPECT_EQ(second.stage(), CommandStage::kRefused);
  EXPECT_EQ(second.reason(), "there is no way to it");
  EXPECT_EQ(third.stage(), CommandStage::kCancelled);
  EXPECT_EQ(third.reason(), std::string(kWaited) + "there is no way to it");
  arrive();
  EXPECT_THAT(queue_.visited, ElementsAre(1.0));
  EXPECT_FALSE(queue_.visit.active());
}

/// However the one under way ends, if it is not done.
TEST_F(QueuedCommands, NeverGoOnBehindOneThatWasNotDone) {
  const std::pair<std::function<void(CommandHandle&)>, std::string> ends[] = {
      {[this](CommandHandle&) { queue_.visit.fail("the motor stalled"); }, "the motor stalled"},
      {[this](CommandHandle& first) { first.cancel(), subordinate_.deliver(); },
       "cancelled by its sender"},
      {[this](CommandHandle&) { queue_.stop(); }, "the component was stopped"},
      {[this](CommandHandle&) { queue_.fault("encoder lost"); }, "encoder lost"}};
  for (const auto& [end, reason] : ends) {
    queue_.visited.clear();
    CommandHandle first = send(1.0);
    const CommandHandle second = send(2.0);
    ASSERT_EQ(second.stage(), CommandStage::kWaiting) << reason;
    end(first);
    EXPECT_EQ(second.stage(), CommandStage::kCancelled) << reason;
    EXPECT_EQ(second.reason(), kWaited + reason);
    if (queue_.state() == State::kException) {
      ASSERT_TRUE(Host::reset(queue_));
    }
    if (queue_.state() == State::kStopped) {
      ASSERT_TRUE(Host::start(queue_));
    }
    arrive();
    EXPECT_THAT(queue_.visited, ElementsAre(1.0)) << reason;
    EXPECT_EQ(queue_.visit.waiting(), 0u);
  }
}

TEST_F(QueuedCommands, CancellingOneThatWaitsEndsItAndThoseBehindIt) {
  const CommandHandle first = send(1.0);
  CommandHandle second = send(2.0);
  const CommandHandle third = send(3.0);
  second.cancel();
  subordinate_.deliver();
  EXPECT_EQ(first.stage(), CommandStage::kAccepted);
  EXPECT_EQ(second.stage(), CommandStage::kCancelled);
  EXPECT_EQ(second.reason(), "cancelled by its sender");
  EXPECT_EQ(third.reason(), std::string(kWaited) + "cancelled by its sender");
  EXPECT_EQ(queue_.brakes, 0) << "it had not begun";
  arrive();
  EXPECT_EQ(first.stage(), CommandStage::kDone);
  EXPECT_THAT(queue_.visited, ElementsAre(1.0));
}

TEST_F(QueuedCommands, OfAToolThatDoesNotFollowThemToo) {
  const std::vector<types::Value> places{types::Value::of(std::vector<double>{1.0, 0.0})};
  EXPECT_TRUE(face(queue_.visit).invoke(places));
  EXPECT_TRUE(face(queue_.visit).invoke(places));
  EXPECT_EQ(queue_.visit.waiting(), 1u);
  arrive();
  EXPECT_THAT(queue_.visited, ElementsAre(1.0, 1.0));
  queue_.stop();
}

TEST_F(QueuedCommands, AllocateNothing) {
  static_cast<void>(send(1.0));
  const std::vector<double> places{2.0, 0.0};
  armature::testing::RealtimeGuard guard;
  queue_.visited.reserve(100);
  const auto violations = guard.watch([&] {
    for (int i = 0; i < 20; ++i) {
      const std::array<const void*, 1> arguments{&places};
      static_cast<void>(face(queue_.visit).begin_from(nullptr, arguments.data()));
      arrive();
    }
  });
  EXPECT_EQ(violations, 0u) << guard.report();
  EXPECT_EQ(queue_.visited.size(), 21u);
}

}  // namespace
}  // namespace armature::component
