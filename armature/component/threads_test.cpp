// SPDX-License-Identifier: Apache-2.0
// Components in real threads. What is counted must add up; ThreadSanitizer looks for races.
#include <thread>

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

constexpr int kRounds = 20'000;

/// A thread that handles messages until it is destroyed, and then those that are left.
class LiveThread {
 public:
  template <typename... Components>
  explicit LiveThread(Components&... components) {
    hand_.add(components...);
    hand_.context.live = true;
    hand_.context.wakes_on_messages = true;
  }
  /// After everything is connected and started.
  void run() {
    thread_ = std::thread([this] {
      while (!ended_.load(std::memory_order_acquire)) {
        hand_.context.wakeup.wait();
        hand_.cycle();
      }
    });
  }
  void end() {
    if (!thread_.joinable()) return;
    ended_.store(true, std::memory_order_release);
    hand_.context.wakeup.notify();
    thread_.join();
    hand_.context.live = false;
    hand_.deliver();
  }
  ~LiveThread() { end(); }

  ExecutionContext& context() { return hand_.context; }

 private:
  TestThread hand_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

class Collector : public Component {
 public:
  explicit Collector(std::string name) : Component(std::move(name)) {}
  InputPort<int> in{this, "In", "each value", "", on_data<&Collector::take>, fan_in};
  std::uint64_t taken = 0;
  std::uint64_t out_of_order = 0;

 private:
  void take(const int& value) {
    ++taken;
    if (value <= last_) ++out_of_order;
    last_ = value;
  }
  int last_ = -1;
};

class PortsBetweenThreads : public testing::TestWithParam<ConnectionPolicy> {};

TEST_P(PortsBetweenThreads, EveryValueIsHandledInOrderOrCountedWhereItWasLost) {
  Writer<int> writer("writer");
  Collector collector("collector");
  TestThread mine(writer);
  LiveThread theirs(collector);
  face(writer.out).connect(face(collector.in), GetParam());
  start(writer, collector);
  theirs.run();
  std::uint64_t refused = 0;
  for (int i = 0; i < kRounds; ++i) {
    if (writer.out.write(i) == WriteStatus::kFull) ++refused;
  }
  const bool last_refused = writer.out.write(kRounds) == WriteStatus::kFull;
  theirs.end();
  EXPECT_EQ(collector.out_of_order, 0u);
  EXPECT_EQ(face(writer.out).counters().refused, refused + (last_refused ? 1 : 0));
  if (!last_refused) {
    EXPECT_EQ(collector.taken + face(collector.in).counters().missed,
              static_cast<std::uint64_t>(kRounds) + 1);
  }
}

constexpr const char* kPolicyNames[] = {"Latest", "Fifo", "DroppingFifo"};
INSTANTIATE_TEST_SUITE_P(Policies, PortsBetweenThreads,
                         testing::Values(latest(), fifo(8), fifo(8, rt::WhenFull::kDropOldest)),
                         [](const auto& test) { return kPolicyNames[test.index]; });

TEST(FanInBetweenThreads, SeveralWritersOnOneInputLoseNothingUntold) {
  Writer<int> a("a");
  Writer<int> b("b");
  Collector collector("collector");
  TestThread one(a);
  TestThread two(b);
  LiveThread theirs(collector);
  face(a.out).connect(face(collector.in), fifo(16));
  face(b.out).connect(face(collector.in), fifo(16));
  start(a, b, collector);
  theirs.run();
  std::thread other([&] {
    for (int i = 0; i < kRounds; ++i) b.out.write(i);
  });
  for (int i = 0; i < kRounds; ++i) a.out.write(i);
  other.join();
  theirs.end();
  EXPECT_EQ(collector.taken + face(a.out).counters().refused + face(b.out).counters().refused,
            2u * static_cast<std::uint64_t>(kRounds));
}

// --- operations ----------------------------------------------------------------------------------

class Counter : public Component {
 public:
  using Component::Component;
  Operation<int(int)> add{this, "add", serve<&Counter::do_add>, "adds", in_own_thread};
  Operation<std::int64_t()> ask_time{this, "time", serve<&Counter::do_time>, "anyone's thread"};
  Operation<void()> fail{this, "fail", serve<&Counter::do_fail>, "throws, anyone's thread"};
  Command<int> count_to{this, "countTo", serve<&Counter::begin>, "counts",
                        cancelled_by<&Counter::note_cancel>};
  Event<int> counted{this, "counted", "one more"};
  EventHandler<int> told{this, "counted", serve<&Counter::take>, "counts"};
  Trigger turn{"turn"};
  StateMachine machine{this, "phase", "turns", in_state("A", on(turn, to("B/C"))),
                       in_state("B", on(turn, to("A")), in_state("C"))};
  int total = 0;
  int begun = 0;
  int cancelled = 0;
  int events = 0;

 private:
  int do_add(int value) {
    turn.raise();
    return total += value;
  }
  std::int64_t do_time() { return base::to_ns(time()); }
  void do_fail() { throw std::runtime_error("on purpose"); }
  Outcome begin(int how) {
    ++begun;
    if (how == 0) count_to.complete();
    return accepted();
  }
  void note_cancel() { ++cancelled; }
  void take(int) { ++events; }
};

class Client : public Component {
 public:
  using Component::Component;
  OperationCaller<int(int)> add{this, "add", "of the counter"};
  OperationCaller<std::int64_t()> ask_time{this, "time", "of the counter"};
  OperationCaller<void()> fail{this, "fail", "of the counter"};
  CommandCaller<int> count_to{this, "countTo", "of the counter"};
};

class CallsBetweenThreads : public testing::Test {
 protected:
  CallsBetweenThreads() : theirs_(counter_), mine_(client_) {
    face(client_.add).connect(face(counter_.add));
    face(client_.ask_time).connect(face(counter_.ask_time));
    face(client_.fail).connect(face(counter_.fail));
    face(client_.count_to).connect(face(counter_.count_to));
    start(counter_, client_);
  }
  ~CallsBetweenThreads() override { theirs_.end(); }
  Counter counter_{"counter"};
  Client client_{"client"};
  LiveThread theirs_;
  TestThread mine_;
};

TEST_F(CallsBetweenThreads, EachCallReturnsItsOwnResult) {
  theirs_.run();
  for (int i = 1; i <= kRounds / 10; ++i) {
    const CallResult<int> result = client_.add(1);
    ASSERT_EQ(result.status, CallStatus::kDone);
    ASSERT_EQ(result.value, i);
  }
}

TEST_F(CallsBetweenThreads, ASentCallIsExecutedOrCancelledNeverBoth) {
  theirs_.run();
  int cancelled = 0;
  int sent = 0;
  for (int i = 0; i < kRounds; ++i) {
    SendHandle<int> handle = client_.add.send(1);
    if (!handle.sent()) continue;
    ++sent;
    if (i % 2 == 0 && handle.cancel()) ++cancelled;
  }
  theirs_.end();
  EXPECT_GT(sent, 0);
  EXPECT_EQ(counter_.total + cancelled, sent);
}

TEST_F(CallsBetweenThreads, ACommandEndsExactlyOnceWhateverIsCancelled) {
  theirs_.run();
  int begun_or_cancelled = 0;
  int sent = 0;
  for (int i = 0; i < kRounds / 10; ++i) {
    CommandHandle handle = client_.count_to.send(i % 3);
    if (!handle.sent()) continue;
    ++sent;
    handle.cancel();
    while (!handle.ended()) std::this_thread::yield();
    EXPECT_NE(handle.stage(), CommandStage::kFailed);
    if (handle.stage() != CommandStage::kRefused) ++begun_or_cancelled;
  }
  theirs_.end();
  EXPECT_EQ(begun_or_cancelled, sent) << "the one before had always ended";
  EXPECT_FALSE(counter_.count_to.active());
}

TEST_F(CallsBetweenThreads, AGuestReadsTheTimeAndItsExceptionFaultsTheOwnerOnce) {
  TestSupervisor supervisor;
  theirs_.context().supervisor = &supervisor;
  theirs_.run();
  for (int i = 0; i < kRounds / 10; ++i) {
    static_cast<void>(client_.add.send(1));
    EXPECT_GE(client_.ask_time().value, 0);
  }
  int failed = 0;
  for (int i = 0; i < 100; ++i) {
    const CallStatus status = client_.fail().status;
    if (status == CallStatus::kFailed) ++failed;
    if (status == CallStatus::kNotReady) break;
    theirs_.context().wakeup.notify();
  }
  theirs_.end();
  EXPECT_GE(failed, 1);
  EXPECT_EQ(counter_.state(), State::kException);
  EXPECT_EQ(counter_.reason(), "exception: on purpose");
  EXPECT_EQ(supervisor.faulted.size(), 1u);
}

TEST_F(CallsBetweenThreads, HandlesMayBeLetGoOfByAnyoneAfterTheCallerIsDisconnected) {
  theirs_.run();
  for (int i = 0; i < 500; ++i) {
    SendHandle<int> handle = client_.add.send(1);
    face(client_.add).disconnect();
    if (i % 2 == 0) static_cast<void>(handle.wait(std::chrono::seconds(10)));
    face(client_.add).connect(face(counter_.add));
  }
  theirs_.end();
  EXPECT_EQ(counter_.total, 500);
}

TEST_F(CallsBetweenThreads, ToolsWatchTheStateOfAComponentAndItsMachineFromOutside) {
  theirs_.run();
  std::atomic<bool> watching{true};
  std::size_t seen = 0;
  std::thread tool([&] {
    while (watching.load(std::memory_order_relaxed)) {
      const std::string_view path = counter_.machine.path();
      EXPECT_TRUE(path == "A" || path == "B" || path == "B/C") << path;
      if (counter_.state() == State::kRunning) ++seen;
    }
  });
  for (int i = 0; i < kRounds; ++i) static_cast<void>(client_.add.send(1));
  while (client_.add(0).status != CallStatus::kDone) {
  }
  watching.store(false, std::memory_order_relaxed);
  tool.join();
  theirs_.end();
}

TEST(EventsBetweenThreads, EveryEventIsHandledOrCounted) {
  Counter raiser("raiser");
  Counter listener("listener");
  TestThread mine(raiser);
  LiveThread theirs(listener);
  face(raiser.counted).subscribe(face(listener.told));
  start(raiser, listener);
  theirs.run();
  int refused = 0;
  for (int i = 0; i < kRounds; ++i) {
    if (raiser.counted.raise(i) == RaiseStatus::kQueueFull) ++refused;
  }
  theirs.end();
  EXPECT_EQ(face(listener.told).dropped(), static_cast<std::uint64_t>(refused));
  EXPECT_EQ(listener.events + refused, kRounds);
}

}  // namespace
}  // namespace armature::component
