// SPDX-License-Identifier: Apache-2.0
#include "armature/component/entrance.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

/// Hands every value on, whatever wiring makes of it.
class Relay final : public Component {
 public:
  using Component::Component;

  InputPort<int> in{this, "In", "is handed on", "", on_data<&Relay::on_in>, may_stay_open};
  InputPort<int> update_in{this, "UpdateIn", "makes an update", "", on_data_update, may_stay_open};
  OutputPort<int> out{this, "Out", "what arrived"};
  Operation<void(int)> pass_on{this, "passOn", serve<&Relay::do_pass_on>, "writes Out"};
  OperationCaller<void(int)> next{this, "passOn", "is called with every value", optional};
  Event<int> arrived{this, "arrived", "a value came"};
  EventHandler<int> peer_arrived{this, "arrived", serve<&Relay::on_in>, "like In", optional};

  int values = 0;
  int highest = 1000;

 private:
  void on_in(const int& value) {
    ++values;
    if (value < highest) do_pass_on(value + 1);
  }
  void on_update() override {
    ++values;
    if (update_in.read().value < highest) out.write(update_in.read().value + 1);
  }
  void do_pass_on(int value) {
    out.write(value);
    arrived.raise(value);
    if (next.bound()) static_cast<void>(next(value));
  }
};

/// Three in one thread; wired by each test.
class Reentrance : public testing::Test {
 protected:
  Reentrance() : thread_(a_, b_, c_) { thread_.context.supervisor = &supervisor_; }

  void start_all() { start(a_, b_, c_); }
  void expect_fault(const Relay& who, const char* reason) {
    EXPECT_EQ(who.state(), State::kException);
    EXPECT_EQ(who.reason(), reason);
    EXPECT_THAT(supervisor_.faulted, testing::ElementsAre(who.name()));
  }

  Relay a_{"A"};
  Relay b_{"B"};
  Relay c_{"C"};
  TestSupervisor supervisor_;
  TestThread thread_;
};

TEST_F(Reentrance, APortsHandlerThatSetsItselfOffFaultsItsComponentWithTheWayItTook) {
  face(a_.out).connect(face(b_.in), {});
  face(b_.out).connect(face(c_.in), {});
  face(c_.out).connect(face(b_.in), {});
  start_all();
  a_.out.write(1);
  expect_fault(b_, "a handler set itself off: B.In -> C.In -> B.In");
  EXPECT_EQ(b_.values, 1);
  EXPECT_EQ(c_.values, 1);
  EXPECT_EQ(a_.state(), State::kRunning);
  EXPECT_EQ(c_.state(), State::kRunning);
}

TEST_F(Reentrance, SoDoesAnEventsHandler) {
  face(a_.arrived).subscribe(face(b_.peer_arrived));
  face(b_.arrived).subscribe(face(a_.peer_arrived));
  start_all();
  a_.arrived.raise(1);
  expect_fault(b_, "a handler set itself off: B.arrived -> A.arrived -> B.arrived");
}

TEST_F(Reentrance, SoDoesAnUpdateThatDataSetOff) {
  face(a_.out).connect(face(b_.update_in), {});
  face(b_.out).connect(face(a_.in), {});
  start_all();
  a_.out.write(1);
  expect_fault(b_, "a handler set itself off: B.UpdateIn -> A.In -> B.UpdateIn");
  EXPECT_EQ(b_.values, 1);
}

TEST_F(Reentrance, AWayThroughAnOperationIsNoticedToo) {
  face(a_.out).connect(face(b_.in), {});
  face(b_.next).connect(face(a_.pass_on));
  start_all();
  a_.out.write(1);
  expect_fault(b_, "a handler set itself off: B.In -> B.In");
}

TEST_F(Reentrance, HandlersMayNestAndRunAgainAfterwards) {
  face(a_.out).connect(face(b_.in), {});
  face(b_.out).connect(face(c_.in), {});
  start_all();
  a_.out.write(1);
  a_.out.write(2);
  EXPECT_EQ(b_.values, 2);
  EXPECT_EQ(c_.values, 2);
  EXPECT_TRUE(supervisor_.faulted.empty());
}

TEST_F(Reentrance, AnExceptionLeavesTheHandlerOpenForTheNextTime) {
  class Thrower final : public Component {
   public:
    using Component::Component;
    InputPort<int> in{this, "In", "throws", "", on_data<&Thrower::on_in>};
    int calls = 0;

   private:
    void on_in() {
      if (++calls == 1) throw 1;
    }
  };
  Thrower thrower("thrower");
  thread_.add(thrower);
  face(a_.out).connect(face(thrower.in), {});
  start_all();
  start(thrower);
  a_.out.write(1);
  EXPECT_EQ(thrower.state(), State::kException);
  ASSERT_TRUE(Host::reset(thrower));
  start(thrower);
  a_.out.write(2);
  EXPECT_EQ(thrower.calls, 2);
  EXPECT_EQ(thrower.state(), State::kRunning);
}

TEST_F(Reentrance, OperationsThatCallEachOtherWithoutEndFaultBeforeTheStackIsUsedUp) {
  class Caller final : public Component {
   public:
    using Component::Component;
    Operation<void()> call{this, "call", serve<&Caller::do_call>, "calls the other one"};
    OperationCaller<void()> other{this, "call", "the other one"};
    int calls = 0;

   private:
    void do_call() {
      ++calls;
      static_cast<void>(other());
    }
  };
  Caller first("first");
  Caller second("second");
  thread_.add(first, second);
  face(first.other).connect(face(second.call));
  face(second.other).connect(face(first.call));
  start(first, second);
  EXPECT_EQ(face(first.call).execute_here(thread_.context, nullptr, nullptr), CallStatus::kDone);
  EXPECT_EQ(first.calls + second.calls, kLeastDepthLimit);
  EXPECT_EQ(first.state(), State::kException);
  EXPECT_EQ(first.reason(),
            "handlers and operations nest too deeply in the thread 'thread': look for calls that "
            "go in a circle");
  EXPECT_EQ(thread_.context.next_hook, thread_.context.hooks.get());
}

TEST(Entrance, ALongWayIsShortenedInTheMiddle) {
  std::vector<std::unique_ptr<Relay>> ring;
  TestThread thread;
  for (int i = 0; i < 20; ++i) {
    ring.push_back(std::make_unique<Relay>("R" + std::to_string(i)));
    thread.add(*ring.back());
    start(*ring.back());
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    face(ring[i]->out).connect(face(ring[(i + 1) % ring.size()]->in), {});
  }
  ring[19]->out.write(1);
  EXPECT_EQ(ring[0]->reason(),
            "a handler set itself off: R0.In -> ... -> R13.In -> R14.In -> R15.In -> R16.In -> "
            "R17.In -> R18.In -> R19.In -> R0.In");
}

}  // namespace
}  // namespace armature::component
