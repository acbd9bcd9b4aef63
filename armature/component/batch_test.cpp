// SPDX-License-Identifier: Apache-2.0
// Small values for handlers in another thread travel in batches: what one hook writes is one
// message.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/rt/guard.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Sender : public Component {
 public:
  using Component::Component;
  OutputPort<int> first{this, "First", "a number"};
  OutputPort<double> second{this, "Second", "another"};
  Operation<void()> act{this, "act", serve<&Sender::write_first>, "writes", in_own_thread};

 private:
  void write_first() { first.write(1); }
};

class Customer : public Component {
 public:
  using Component::Component;
  OperationCaller<void()> act{this, "act", "writes"};
};

class Receiver : public Component {
 public:
  using Component::Component;
  InputPort<int> first{this, "First", "a number", "", on_data<&Receiver::on_first>};
  InputPort<double> second{this, "Second", "another", "", on_data<&Receiver::on_second>};
  std::vector<int> numbers;
  bool throws = false;

 private:
  void on_first(const int& value) {
    numbers.push_back(value);
    if (throws) throw std::runtime_error("no");
  }
  void on_second(const double& value) { numbers.push_back(static_cast<int>(value)); }
};

class Batches : public testing::Test {
 protected:
  Batches() : here_(sender_), there_(receiver_), sending_(here_.context.outbox) {
    face(sender_.first).connect(face(receiver_.first), latest());
    face(sender_.second).connect(face(receiver_.second), latest());
    start(sender_, receiver_);
    there_.context.live = true;
    here_.prepare_lanes();
  }
  void flush() { here_.context.outbox.flush(); }

  Sender sender_{"sender"};
  Receiver receiver_{"receiver"};
  TestThread here_;
  TestThread there_;
  const rt::Outbox::Scope sending_;
};

TEST_F(Batches, WhatAHookWritesIsOneMessage) {
  sender_.first.write(1);
  sender_.second.write(2.0);
  EXPECT_TRUE(there_.context.inbox.empty());
  flush();
  EXPECT_EQ(there_.deliver_and_count(), 1);
  EXPECT_THAT(receiver_.numbers, ElementsAre(1, 2));
}

TEST_F(Batches, EachValueOfAPortThatIsWrittenTwiceIsHandled) {
  sender_.first.write(1);
  sender_.first.write(2);
  flush();
  there_.deliver();
  EXPECT_THAT(receiver_.numbers, ElementsAre(1, 2));
  EXPECT_EQ(face(receiver_.first).counters().missed, 0u);
}

TEST_F(Batches, AReaderThatIsSlowGetsTheNewestLastAndKnowsWhatItMissed) {
  constexpr int kWrites = 50;
  for (int value = 1; value <= kWrites; ++value) {
    EXPECT_EQ(sender_.first.write(value), WriteStatus::kWritten);
    flush();
  }
  there_.deliver();
  EXPECT_TRUE(std::is_sorted(receiver_.numbers.begin(), receiver_.numbers.end()));
  EXPECT_LT(receiver_.numbers.size(), static_cast<std::size_t>(kWrites));
  EXPECT_EQ(receiver_.numbers.back(), kWrites);
  EXPECT_EQ(receiver_.numbers.size() + face(receiver_.first).counters().missed,
            static_cast<std::size_t>(kWrites));
  receiver_.numbers.clear();
  sender_.first.write(kWrites + 1);
  flush();
  there_.deliver();
  EXPECT_THAT(receiver_.numbers, ElementsAre(kWrites + 1)) << "batches are used again";
}

TEST_F(Batches, AReadingStaysWhileNewValuesAreOnTheirWay) {
  sender_.first.write(1);
  flush();
  there_.deliver();
  const Reading<int> reading = receiver_.first.read();
  sender_.first.write(2);
  flush();
  EXPECT_EQ(reading.value, 1);
}

TEST_F(Batches, AHandlerThatThrowsDoesNotKeepTheRestFromOthers) {
  Receiver other("other");
  there_.add(other);
  face(sender_.second).connect(face(other.second), latest());
  start(other);
  here_.prepare_lanes();
  receiver_.throws = true;
  sender_.first.write(1);
  sender_.second.write(2.0);
  flush();
  there_.deliver();
  EXPECT_EQ(receiver_.state(), State::kException);
  EXPECT_THAT(receiver_.numbers, ElementsAre(1));
  EXPECT_THAT(other.numbers, ElementsAre(2));
}

TEST_F(Batches, WhatIsWrittenWhereTheWriterMayWaitGoesAtOnce) {
  sender_.first.write(1);
  {
    const rt::PermitScope waiting;
    sender_.second.write(2.0);
    there_.deliver();
  }
  EXPECT_THAT(receiver_.numbers, ElementsAre(1, 2));
}

TEST_F(Batches, WhatAnOperationWroteIsOnItsWayBeforeItsCallerGoesOn) {
  Customer customer("customer");
  TestThread elsewhere(customer);
  face(customer.act).connect(face(sender_.act));
  here_.context.live = true;
  const auto call = customer.act.send();
  here_.deliver();
  EXPECT_TRUE(call.done());
  EXPECT_FALSE(there_.context.inbox.empty());
}

TEST_F(Batches, AStoppedReaderHandlesNothingAndFindsTheNewestWhenItLooks) {
  Host::stop(receiver_);
  sender_.first.write(1);
  sender_.first.write(2);
  flush();
  there_.deliver();
  EXPECT_THAT(receiver_.numbers, IsEmpty());
  EXPECT_EQ(receiver_.first.read().value, 2);
}

}  // namespace
}  // namespace armature::component
