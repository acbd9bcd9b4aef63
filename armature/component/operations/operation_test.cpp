// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/rt/log.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Calculator : public Component {
 public:
  using Component::Component;
  Operation<double(double, double)> add{this, "add", serve<&Calculator::do_add>, "adds",
                                        args("a [m]", "b [m]")};
  Operation<double(double, double)> add_here{this, "add_here", serve<&Calculator::do_add>,
                                             "adds in its own thread", in_own_thread};
  Operation<void()> reset{this, "reset", serve<&Calculator::do_reset>, "forgets", in_own_thread};
  Operation<std::vector<double>(const std::vector<double>&)> twice{
      this, "twice", serve<&Calculator::do_twice>, "doubles each"};

  std::vector<double> sums;
  int resets = 0;
  std::function<void()> then;

 private:
  double do_add(double a, double b) {
    if (then) then();
    sums.push_back(a + b);
    return a + b;
  }
  void do_reset() {
    if (then) then();
    ++resets;
  }
  std::vector<double> do_twice(const std::vector<double>& values) const {
    std::vector<double> doubled;
    for (const double value : values) doubled.push_back(2 * value);
    return doubled;
  }
};

class Client : public Component {
 public:
  using Component::Component;
  OperationCaller<double(double, double)> add{this, "add", "adds", outstanding(2)};
  OperationCaller<void()> reset{this, "reset", "forgets", optional};
  OperationCaller<std::vector<double>(const std::vector<double>&)> twice{this, "twice", "doubles"};
};

/// Client and server in one thread, or each in its own, which is live.
class OperationTest : public testing::Test {
 protected:
  void in_one_thread() { one_.add(client_, server_); }
  void in_two_threads() {
    one_.add(client_);
    other_.add(server_);
    one_.context.live = true;
    other_.context.live = true;
  }
  Calculator server_{"server"};
  Client client_{"client"};
  TestThread one_{"one"};
  TestThread other_{"other"};
};

using Calls = OperationTest;

TEST_F(Calls, AnUnboundCallerSaysSoInsteadOfReturningZero) {
  in_one_thread();
  EXPECT_FALSE(client_.add.bound());
  const CallResult<double> result = client_.add(1.0, 2.0);
  EXPECT_FALSE(result);
  EXPECT_EQ(result.status, CallStatus::kNotConnected);
  EXPECT_EQ(client_.add.send(1.0, 2.0).collect().status, CallStatus::kNotConnected);
}

TEST_F(Calls, AnOperationOfWhatIsNotConfiguredSaysThatItIsNotReady) {
  in_one_thread();
  face(client_.add).connect(face(server_.add));
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kNotReady);
  start(server_);
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kDone);
  server_.fault("for the test");
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kNotReady);
}

TEST_F(Calls, InOneThreadTheyRunAtOnceAndReturnTheResult) {
  in_one_thread();
  start(server_);
  for (Operation<double(double, double)>* operation : {&server_.add, &server_.add_here}) {
    face(client_.add).connect(face(*operation));
    const CallResult<double> result = client_.add(1.0, 2.5);
    EXPECT_TRUE(result);
    EXPECT_EQ(result.value, 3.5);
  }
  face(client_.twice).connect(face(server_.twice));
  EXPECT_THAT(client_.twice({1.0, 2.0}).value, ElementsAre(2.0, 4.0));
}

TEST_F(Calls, WithoutAnOptionAnOperationRunsInTheCallersThread) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add));
  const Component* running = nullptr;
  server_.then = [&] { running = one_.context.running(); };
  EXPECT_EQ(client_.add(1.0, 2.0).value, 3.0);
  EXPECT_EQ(running, &server_);
  EXPECT_TRUE(other_.context.inbox.empty());
}

TEST_F(Calls, OneOfAThreadThatDoesNotRunYetRunsAtOnce) {
  one_.add(client_);
  other_.add(server_);
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  EXPECT_EQ(client_.add(1.0, 2.0).value, 3.0);
}

TEST_F(Calls, InSimulatedTimeAllThreadsAreOne) {
  in_two_threads();
  other_.context.simulated = true;
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  EXPECT_EQ(client_.add(1.0, 2.0).value, 3.0);
}

// --- send and collect ----------------------------------------------------------------------------

TEST_F(Calls, SentOnesRunInTheOwnersThreadInTheirOrder) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  SendHandle<double> first = client_.add.send(1.0, 2.0);
  SendHandle<double> second = client_.add.send(3.0, 4.0);
  EXPECT_TRUE(first.sent());
  EXPECT_FALSE(first.done());
  EXPECT_EQ(first.collect().status, CallStatus::kPending);
  other_.deliver();
  EXPECT_TRUE(first.done());
  EXPECT_EQ(first.collect().value, 3.0);
  EXPECT_EQ(second.collect().value, 7.0);
  EXPECT_EQ(second.collect().status, CallStatus::kDone) << "as often as one likes";
  EXPECT_THAT(server_.sums, ElementsAre(3.0, 7.0));
}

TEST_F(Calls, MoreThanTheDeclaredNumberUnderWayIsAnAnswerAndCounted) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  SendHandle<double> first = client_.add.send(1.0, 0.0);
  SendHandle<double> second = client_.add.send(2.0, 0.0);
  SendHandle<double> third = client_.add.send(3.0, 0.0);
  EXPECT_FALSE(third.sent());
  EXPECT_TRUE(third.done());
  EXPECT_EQ(third.collect().status, CallStatus::kQueueFull);
  EXPECT_EQ(face(client_.add).refused(), 1u);
  other_.deliver();
  EXPECT_FALSE(client_.add.send(4.0, 0.0).sent()) << "the results are still held";
  first = client_.add.send(5.0, 0.0);
  EXPECT_FALSE(first.sent());
  first = SendHandle<double>(CallStatus::kPending);
  EXPECT_TRUE(client_.add.send(6.0, 0.0).sent());
  other_.deliver();
}

TEST_F(Calls, LettingGoOfAHandleDoesNotCancelTheCall) {
  in_two_threads();
  start(server_);
  face(client_.reset).connect(face(server_.reset));
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(client_.reset.send().sent());
    other_.deliver();
  }
  EXPECT_EQ(server_.resets, 10);
}

TEST_F(Calls, AQueuedOneCanBeCancelledABegunOneCannot) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  SendHandle<double> queued = client_.add.send(1.0, 2.0);
  EXPECT_TRUE(queued.cancel());
  EXPECT_TRUE(queued.done());
  EXPECT_EQ(queued.collect().status, CallStatus::kCancelled);
  EXPECT_FALSE(queued.cancel());
  other_.deliver();
  EXPECT_THAT(server_.sums, ElementsAre());

  SendHandle<double> begun = client_.add.send(1.0, 2.0);
  bool cancelled = true;
  server_.then = [&] { cancelled = begun.cancel(); };
  other_.deliver();
  EXPECT_FALSE(cancelled);
  EXPECT_EQ(begun.collect().status, CallStatus::kDone);
}

TEST_F(Calls, WaitingEndsWithTheLimitAndTakesTheCallBack) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  SendHandle<double> handle = client_.add.send(1.0, 2.0);
  EXPECT_EQ(handle.wait(base::Duration(1)).status, CallStatus::kTimeout);
  other_.deliver();
  EXPECT_THAT(server_.sums, ElementsAre());
  EXPECT_EQ(handle.collect().status, CallStatus::kCancelled);
}

TEST_F(Calls, AWaitForSomethingDoneReturnsAtOnce) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  SendHandle<double> handle = client_.add.send(1.0, 2.0);
  other_.deliver();
  EXPECT_EQ(handle.wait(base::Duration(0)).value, 3.0);
}

TEST_F(Calls, SentToWhatIsNotReadyTheyAreAnsweredSo) {
  in_two_threads();
  face(client_.add).connect(face(server_.add_here));
  SendHandle<double> handle = client_.add.send(1.0, 2.0);
  other_.deliver();
  EXPECT_EQ(handle.collect().status, CallStatus::kNotReady);
}

TEST_F(Calls, AHandleMayOutliveItsCaller) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  SendHandle<double> handle = client_.add.send(1.0, 2.0);
  SendHandle<double> cancelled = client_.add.send(3.0, 4.0);
  EXPECT_TRUE(cancelled.cancel());
  face(client_.add).disconnect();
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kNotConnected);
  other_.deliver();
  EXPECT_EQ(handle.collect().value, 3.0);
}

// --- exceptions ----------------------------------------------------------------------------------

TEST_F(Calls, AnExceptionFaultsTheOwnerTheCallerIsToldAndGoesOn) {
  in_one_thread();
  start(server_, client_);
  face(client_.add).connect(face(server_.add));
  server_.then = [] { throw std::runtime_error("overflow"); };
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kFailed);
  EXPECT_EQ(server_.state(), State::kException);
  EXPECT_EQ(server_.reason(), "exception: overflow");
  EXPECT_EQ(client_.state(), State::kRunning);
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kNotReady);
}

TEST_F(Calls, AnExceptionInASentOneToo) {
  in_two_threads();
  start(server_);
  face(client_.add).connect(face(server_.add_here));
  server_.then = [] { throw 42; };
  SendHandle<double> handle = client_.add.send(1.0, 2.0);
  other_.deliver();
  EXPECT_EQ(handle.collect().status, CallStatus::kFailed);
  EXPECT_EQ(server_.reason(), "exception of an unknown type");
}

TEST_F(Calls, AnExceptionInTheCallersThreadFaultsTheOwnerInItsOwn) {
  in_two_threads();
  rt::LogQueue log(4);
  other_.context.log = &log;
  start(server_);
  face(client_.add).connect(face(server_.add));
  server_.then = [] { throw std::runtime_error("overflow"); };
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kFailed);
  EXPECT_EQ(client_.add(1.0, 2.0).status, CallStatus::kFailed);
  EXPECT_EQ(server_.state(), State::kRunning);
  EXPECT_EQ(log.pop(), nullptr) << "the log belongs to the other thread";
  other_.deliver();
  EXPECT_EQ(server_.state(), State::kException);
  EXPECT_EQ(server_.reason(), "exception: overflow");
  EXPECT_NE(log.pop(), nullptr);
  EXPECT_EQ(log.pop(), nullptr) << "once";
}

// --- for tools -----------------------------------------------------------------------------------

TEST_F(Calls, ToolsCallByValues) {
  in_one_thread();
  start(server_);
  const auto sum = face(server_.add).invoke({types::Value::of(1.0), types::Value::of(2.0)});
  ASSERT_TRUE(sum);
  ASSERT_TRUE(sum.value().has_value());
  EXPECT_EQ(*sum.value()->get_if<double>(), 3.0);
  const auto nothing = face(server_.reset).invoke({});
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(nothing.value().has_value());
}

TEST_F(Calls, ToolsAreToldWhichArgumentsAreExpected) {
  in_one_thread();
  start(server_);
  const auto one = face(server_.add).invoke({types::Value::of(1.0)});
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error(),
            "'server.add' is double(double a [m], double b [m]); it was called with (double)");
  EXPECT_FALSE(face(server_.add).invoke({types::Value::of(1.0), types::Value::of(2)}));
}

TEST_F(Calls, ToolsAreToldWhyACallDidNotSucceed) {
  in_one_thread();
  const auto unready = face(server_.reset).invoke({});
  ASSERT_FALSE(unready);
  EXPECT_THAT(unready.error(), HasSubstr("reset: not ready"));
  start(server_);
  server_.then = [] { throw std::runtime_error("overflow"); };
  const auto failed = face(server_.reset).invoke({});
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error(), "reset: failed: exception: overflow");
}

TEST_F(Calls, AWrongSignatureIsSeenBeforeConnecting) {
  EXPECT_TRUE(face(client_.add).signature().same_as(face(server_.add).signature()))
      << "names do not count";
  EXPECT_FALSE(face(client_.add).signature().same_as(face(server_.reset).signature()));
  EXPECT_FALSE(face(client_.twice).signature().same_as(face(server_.add).signature()));
  EXPECT_FALSE(face(client_.add).needs_command());
  EXPECT_FALSE(face(server_.add).is_command());
}

TEST(CallNames, AreWords) {
  EXPECT_EQ(name_of(CallStatus::kDone), "done");
  EXPECT_EQ(name_of(CallStatus::kPending), "pending");
  EXPECT_EQ(name_of(CallStatus::kNotConnected), "not connected");
  EXPECT_EQ(name_of(CallStatus::kNotReady), "not ready");
  EXPECT_EQ(name_of(CallStatus::kFailed), "failed");
  EXPECT_EQ(name_of(CallStatus::kCancelled), "cancelled");
  EXPECT_EQ(name_of(CallStatus::kQueueFull), "queue full");
  EXPECT_EQ(name_of(CallStatus::kTimeout), "timeout");
}

}  // namespace
}  // namespace armature::component
