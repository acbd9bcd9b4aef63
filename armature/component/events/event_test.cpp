// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/events/event_tap.hpp"
#include "armature/component/host.hpp"
#include "armature/rt/log.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

class Raiser : public Component {
 public:
  using Component::Component;
  Event<int> happened{this, "happened", "something happened", {"count"}};
};

class Listener : public Component {
 public:
  template <typename... Options>
  explicit Listener(std::string name, Options... options)
      : Component(std::move(name)),
        handler(this, "happened", serve<&Listener::take>, "notes it", options...) {}

  EventHandler<int> handler;
  std::vector<int> taken;
  int updates = 0;
  std::function<void()> then;
  std::function<void()> in_update;

 private:
  void take(int count) {
    taken.push_back(count);
    if (then) then();
  }
  void on_update() override {
    ++updates;
    if (in_update) in_update();
  }
};

class EventTest : public testing::Test {
 protected:
  EventTest() : thread_(raiser_) {}
  Raiser raiser_{"raiser"};
  TestThread thread_;
  TestThread other_{"other"};
};

using Events = EventTest;

TEST_F(Events, NobodyListeningIsAnAnswer) {
  EXPECT_EQ(raiser_.happened.raise(1), RaiseStatus::kNobodyListens);
  EXPECT_EQ(face(raiser_.happened).raised(), 1u);
}

TEST_F(Events, InOneThreadHandlersRunAtOnceInTheOrderOfSubscription) {
  std::vector<std::string> order;
  Listener a("a");
  Listener b("b");
  thread_.add(a, b);
  face(raiser_.happened).subscribe(face(b.handler));
  face(raiser_.happened).subscribe(face(a.handler));
  start(a, b);
  a.then = [&] { order.push_back("a"); };
  b.then = [&] { order.push_back("b"); };
  EXPECT_EQ(raiser_.happened.raise(7), RaiseStatus::kDelivered);
  EXPECT_THAT(a.taken, ElementsAre(7));
  EXPECT_THAT(order, ElementsAre("b", "a"));
}

TEST_F(Events, InAnotherThreadAHandlerRunsOncePerEventInOrder) {
  Listener listener("listener");
  other_.add(listener);
  face(raiser_.happened).subscribe(face(listener.handler));
  start(listener);
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(raiser_.happened.raise(i), RaiseStatus::kDelivered);
  EXPECT_THAT(listener.taken, ElementsAre());
  other_.deliver();
  EXPECT_THAT(listener.taken, ElementsAre(1, 2, 3));
  other_.deliver();
  EXPECT_EQ(listener.taken.size(), 3u);
  EXPECT_EQ(listener.updates, 0) << "a handler does not cause an update";
}

TEST_F(Events, ThoseInOtherThreadsAreToldBeforeThoseInThisOneRun) {
  Listener here("here");
  Listener there("there");
  thread_.add(here);
  other_.add(there);
  face(raiser_.happened).subscribe(face(here.handler));
  face(raiser_.happened).subscribe(face(there.handler));
  start(here, there);
  bool told = false;
  here.then = [&] { told = !other_.context.inbox.empty(); };
  raiser_.happened.raise(1);
  EXPECT_TRUE(told);
}

TEST_F(Events, AFullQueueIsAnAnswerToTheRaiserAndCounted) {
  Listener listener("listener", queue(2));
  Listener roomy("roomy", queue(8));
  other_.add(listener, roomy);
  face(raiser_.happened).subscribe(face(listener.handler));
  face(raiser_.happened).subscribe(face(roomy.handler));
  start(listener, roomy);
  EXPECT_EQ(raiser_.happened.raise(1), RaiseStatus::kDelivered);
  EXPECT_EQ(raiser_.happened.raise(2), RaiseStatus::kDelivered);
  EXPECT_EQ(raiser_.happened.raise(3), RaiseStatus::kQueueFull);
  EXPECT_EQ(face(listener.handler).dropped(), 1u);
  EXPECT_EQ(face(roomy.handler).dropped(), 0u);
  other_.deliver();
  EXPECT_THAT(listener.taken, ElementsAre(1, 2));
  EXPECT_THAT(roomy.taken, ElementsAre(1, 2, 3));
  EXPECT_EQ(raiser_.happened.raise(4), RaiseStatus::kDelivered);
}

TEST_F(Events, HandlersOfOneThreadAreOneMessageInTheOrderOfTheirSubscription) {
  std::vector<std::string> order;
  Listener one("one");
  Listener two("two");
  Listener small("small", queue(1));
  Listener last("last");
  for (Listener* each : {&one, &two, &small, &last}) {
    other_.add(*each);
    face(raiser_.happened).subscribe(face(each->handler));
    each->then = [&order, each] { order.push_back(each->name()); };
    start(*each);
  }
  raiser_.happened.raise(1);
  EXPECT_EQ(other_.deliver_and_count(), 3) << "those that declared another size have their own";
  EXPECT_THAT(order, testing::ElementsAre("one", "two", "small", "last"));
}

TEST_F(Events, TheCapacityOfAQueueIsKnownBeforeTheStart) {
  Listener usual("usual");
  Listener declared("declared", queue(300));
  EXPECT_EQ(face(usual.handler).queue_capacity(), kDefaultEventQueue);
  EXPECT_EQ(face(declared.handler).queue_capacity(), 300u);
  other_.add(declared);
  face(raiser_.happened).subscribe(face(declared.handler));
  start(declared);
  for (int i = 0; i < 300; ++i) ASSERT_EQ(raiser_.happened.raise(i), RaiseStatus::kDelivered);
  EXPECT_EQ(raiser_.happened.raise(300), RaiseStatus::kQueueFull);
  other_.deliver();
  EXPECT_EQ(declared.taken.size(), 300u);
}

TEST_F(Events, InRaisersThreadTheHandlerRunsThereAtOnce) {
  Listener listener("listener", in_raisers_thread);
  other_.add(listener);
  other_.context.live = true;
  face(raiser_.happened).subscribe(face(listener.handler));
  start(listener);
  raiser_.happened.raise(5);
  EXPECT_THAT(listener.taken, ElementsAre(5));
  EXPECT_TRUE(other_.context.inbox.empty());
}

TEST_F(Events, AnEventRaisedDuringTheReceiversUpdateIsHandledInTheSameCycle) {
  Listener listener("listener");
  other_.add(listener);
  face(raiser_.happened).subscribe(face(listener.handler));
  start(listener);
  other_.cycle();
  listener.in_update = [&] {
    raiser_.happened.raise(1);
    EXPECT_THAT(listener.taken, ElementsAre()) << "the update is not interrupted";
  };
  Host::update(listener);
  other_.deliver();
  EXPECT_THAT(listener.taken, ElementsAre(1));
  EXPECT_EQ(listener.updates, 1);
}

TEST_F(Events, WhatDoesNotRunIsNotTold) {
  Listener listener("listener");
  thread_.add(listener);
  face(raiser_.happened).subscribe(face(listener.handler));
  raiser_.happened.raise(1);
  ASSERT_TRUE(Host::configure(listener));
  raiser_.happened.raise(2);
  ASSERT_TRUE(Host::start(listener));
  raiser_.happened.raise(3);
  Host::stop(listener);
  raiser_.happened.raise(4);
  EXPECT_THAT(listener.taken, ElementsAre(3));
}

TEST_F(Events, WhatWasQueuedBeforeTheReceiverRunsIsHandledWhenItDoes) {
  Listener listener("listener");
  other_.add(listener);
  face(raiser_.happened).subscribe(face(listener.handler));
  raiser_.happened.raise(1);
  start(listener);
  other_.deliver();
  EXPECT_THAT(listener.taken, ElementsAre(1));
}

TEST_F(Events, AnExceptionInAHandlerBelongsToItsComponentAndTheRaiserGoesOn) {
  Listener broken("broken");
  Listener healthy("healthy");
  thread_.add(broken, healthy);
  face(raiser_.happened).subscribe(face(broken.handler));
  face(raiser_.happened).subscribe(face(healthy.handler));
  start(raiser_, broken, healthy);
  broken.then = [] { throw std::runtime_error("cannot react"); };
  EXPECT_EQ(raiser_.happened.raise(1), RaiseStatus::kDelivered);
  EXPECT_EQ(broken.state(), State::kException);
  EXPECT_EQ(broken.reason(), "exception: cannot react");
  EXPECT_EQ(raiser_.state(), State::kRunning);
  EXPECT_THAT(healthy.taken, ElementsAre(1));
}

TEST_F(Events, AnExceptionInTheRaisersThreadFaultsTheReceiverInItsOwn) {
  Listener listener("listener", in_raisers_thread);
  rt::LogQueue log(4);
  other_.add(listener);
  other_.context.live = true;
  other_.context.log = &log;
  face(raiser_.happened).subscribe(face(listener.handler));
  start(listener);
  listener.then = [] { throw std::runtime_error("cannot react"); };
  raiser_.happened.raise(1);
  raiser_.happened.raise(2);
  EXPECT_EQ(listener.state(), State::kRunning) << "its state belongs to its thread";
  EXPECT_EQ(log.pop(), nullptr);
  other_.deliver();
  EXPECT_EQ(listener.state(), State::kException);
  EXPECT_EQ(listener.reason(), "exception: cannot react");
  EXPECT_NE(log.pop(), nullptr);
}

TEST_F(Events, AfterUnsubscribingNobodyIsTold) {
  Listener here("here");
  Listener there("there");
  thread_.add(here);
  other_.add(there);
  face(raiser_.happened).subscribe(face(here.handler));
  face(raiser_.happened).subscribe(face(there.handler));
  EXPECT_EQ(face(here.handler).source(), &face(raiser_.happened));
  EXPECT_TRUE(here.handler.bound());
  start(here, there);
  face(raiser_.happened).unsubscribe_all();
  EXPECT_FALSE(here.handler.bound());
  EXPECT_EQ(raiser_.happened.raise(1), RaiseStatus::kNobodyListens);
  other_.deliver();
  EXPECT_THAT(here.taken, ElementsAre());
  EXPECT_THAT(there.taken, ElementsAre());
}

TEST_F(Events, HaveASignatureThatHandlersCanBeComparedWith) {
  Listener listener("listener");
  class Other : public Component {
   public:
    using Component::Component;
    EventHandler<double> handler{this, "happened", serve<&Other::take>, "of another type"};
    void take(double) {}
  };
  Other other("other");
  EXPECT_TRUE(face(raiser_.happened).signature().same_as(face(listener.handler).signature()));
  EXPECT_FALSE(face(raiser_.happened).signature().same_as(face(other.handler).signature()));
  EXPECT_EQ(face(raiser_.happened).signature().text(), "void(int32 count)");
}

// --- taps ----------------------------------------------------------------------------------------

class Noting final : public EventTap {
 public:
  std::vector<int> counts;

 private:
  void event_raised(const void* const* arguments) noexcept override {
    counts.push_back(*static_cast<const int*>(arguments[0]));
  }
};

TEST_F(Events, AreSeenByEachTapUntilItIsRemoved) {
  Noting first;
  Noting second;
  face(raiser_.happened).add_tap(first);
  raiser_.happened.raise(1);
  face(raiser_.happened).add_tap(second);
  raiser_.happened.raise(2);
  face(raiser_.happened).remove_tap(first);
  face(raiser_.happened).remove_tap(first);
  raiser_.happened.raise(3);
  face(raiser_.happened).remove_tap(second);
  raiser_.happened.raise(4);
  EXPECT_THAT(first.counts, ElementsAre(1, 2));
  EXPECT_THAT(second.counts, ElementsAre(2, 3));
}

}  // namespace
}  // namespace armature::component
