// SPDX-License-Identifier: Apache-2.0
// Nothing that a running component does allocates: neither the first time after the start nor ever.
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/rt/log.hpp"
#include "armature/testing/test_thread.hpp"

namespace {
std::size_t allocations = 0;
}  // namespace

// Not inline: the compiler would take malloc and delete for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* const memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace armature::component {
namespace {

using Vector = std::vector<double>;

/// Allocations of the first call and of three more.
template <typename Function>
std::size_t allocations_of(Function function) {
  const std::size_t before = allocations;
  for (int i = 0; i < 4; ++i) function();
  return allocations - before;
}

TEST(RealTime, TheCounterSeesAnAllocation) {
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(8)); }), 4u);
}

// --- ports ---------------------------------------------------------------------------------------

class VectorReader : public Component {
 public:
  template <typename... Options>
  explicit VectorReader(std::string name, Options... options)
      : Component(std::move(name)),
        in(this, "In", "read", "", fan_in, max_age(std::chrono::seconds(1), Reaction::kZero)),
        triggered(this, "Triggered", "handled", "", on_data<&VectorReader::take>, options...) {}
  InputPort<Vector> in;
  InputPort<Vector> triggered;
  double sum = 0.0;

 private:
  void take(const Vector& values) {
    for (const double value : values) sum += value;
  }
};

class PortsInRealTime
    : public testing::TestWithParam<std::tuple<const char*, ConnectionPolicy, bool>> {};

TEST_P(PortsInRealTime, WritingTriggeringAndReadingVectorsAllocateNothing) {
  const auto& [name, policy, same_thread] = GetParam();
  Writer<Vector> writer("writer");
  VectorReader reader("reader");
  TestThread one(writer);
  TestThread two;
  (same_thread ? one : two).add(reader);
  writer.out.set_sample(Vector(7));
  face(writer.out).connect(face(reader.in), policy);
  face(writer.out).connect(face(reader.triggered), policy);
  start(writer, reader);
  const Vector value(7, 1.0);
  const Vector wrong(8, 1.0);
  int reads = 0;
  EXPECT_EQ(allocations_of([&] {
              writer.out.write(value);
              writer.out.write(value);
              writer.out.write(value);  // a FIFO of two is full by now
              writer.out.write(wrong);
              one.cycle();
              two.cycle();
              while (reader.in.read().is_new()) ++reads;
              static_cast<void>(Host::admits(reader));
            }),
            0u);
  EXPECT_GT(reads, 0);
  EXPECT_GT(reader.sum, 0.0);
  EXPECT_EQ(face(writer.out).counters().wrong_size, 4u);
}

INSTANTIATE_TEST_SUITE_P(Connections, PortsInRealTime,
                         testing::Values(std::tuple("LatestInOneThread", latest(), true),
                                         std::tuple("LatestBetweenThreads", latest(), false),
                                         std::tuple("FifoInOneThread", fifo(2), true),
                                         std::tuple("FifoBetweenThreads", fifo(2), false),
                                         std::tuple("DroppingFifo",
                                                    fifo(2, rt::WhenFull::kDropOldest), false),
                                         std::tuple("Delayed", delayed(), true)),
                         [](const auto& test) { return std::get<0>(test.param); });

TEST(PortsInRealTime, ReactionsAllocateNothing) {
  for (const Reaction reaction :
       {Reaction::kHold, Reaction::kZero, Reaction::kStop, Reaction::kFault}) {
    Writer<Vector> writer("writer");
    Reader<Vector> reader("reader", max_age(std::chrono::milliseconds(1), reaction),
                          on_lost(reaction));
    TestThread thread(writer, reader);
    writer.out.set_sample(Vector(3));
    face(writer.out).connect(face(reader.in), latest());
    start(writer, reader);
    EXPECT_EQ(allocations_of([&] {
                thread.cycle(std::chrono::seconds(1));
                static_cast<void>(Host::admits(reader));
                static_cast<void>(reader.in.read());
                writer.fault("for the test");
                thread.cycle();
              }),
              0u);
    EXPECT_GT(face(reader.in).counters().stale + face(reader.in).counters().lost, 0u);
  }
}

// --- operations, commands, events ----------------------------------------------------------------

class Server : public Component {
 public:
  using Component::Component;
  Operation<double(const Vector&)> sum{this, "sum", serve<&Server::do_sum>, "adds up",
                                       in_own_thread};
  Command<double> move{this, "move", serve<&Server::begin>, "moves", done_when<&Server::arrived>};
  Event<int, double> moved{this, "moved", "it moved"};

 private:
  double do_sum(const Vector& values) {
    double total = 0.0;
    for (const double value : values) total += value;
    return total;
  }
  Outcome begin(double target) {
    if (target < 0.0) return refused("behind the wall");
    move.report(0.5);
    return accepted();
  }
  bool arrived() { return true; }
};

class Client : public Component {
 public:
  using Component::Component;
  OperationCaller<double(const Vector&)> sum{this, "sum", "adds up"};
  CommandCaller<double> move{this, "move", "moves"};
  EventHandler<int, double> moved{this, "moved", serve<&Client::take>, "counts"};
  int count = 0;

 private:
  void take(int, double) { ++count; }
};

class CallsInRealTime : public testing::TestWithParam<bool> {
 protected:
  CallsInRealTime() {
    theirs_.add(server_);
    (GetParam() ? theirs_ : mine_).add(client_);
    theirs_.context.live = true;
    mine_.context.live = true;
    face(client_.sum).connect(face(server_.sum));
    face(client_.move).connect(face(server_.move));
    face(server_.moved).subscribe(face(client_.moved));
    client_.sum.prepare(vector_);
    start(server_, client_);
  }
  const Vector vector_ = Vector(7, 1.0);
  Server server_{"server"};
  Client client_{"client"};
  TestThread theirs_;
  TestThread mine_;
};

TEST_P(CallsInRealTime, SendingCollectingAndCancellingAllocateNothing) {
  double total = 0.0;
  EXPECT_EQ(allocations_of([&] {
              if (GetParam()) total += client_.sum(vector_).value;
              SendHandle<double> sent = client_.sum.send(vector_);
              SendHandle<double> cancelled = client_.sum.send(vector_);
              EXPECT_TRUE(cancelled.cancel());
              for (int i = 0; i < 4; ++i) static_cast<void>(client_.sum.send(vector_));
              theirs_.deliver();
              total += sent.collect().value;
            }),
            0u);
  EXPECT_EQ(total, GetParam() ? 56.0 : 28.0);
  EXPECT_GT(face(client_.sum).refused(), 0u);
}

TEST_P(CallsInRealTime, CommandsAllocateNothingHoweverTheyEnd) {
  EXPECT_EQ(allocations_of([&] {
              CommandHandle refused = client_.move.send(-1.0);
              theirs_.deliver();
              EXPECT_EQ(refused.stage(), CommandStage::kRefused);
              CommandHandle cancelled = client_.move.send(1.0);
              theirs_.deliver();
              cancelled.cancel();
              theirs_.deliver();
              EXPECT_EQ(cancelled.stage(), CommandStage::kCancelled);
              CommandHandle done = client_.move.send(1.0);
              theirs_.deliver();
              Host::update(server_);
              EXPECT_EQ(done.stage(), CommandStage::kDone);
            }),
            0u);
}

TEST_P(CallsInRealTime, EventsAllocateNothing) {
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 20; ++i) static_cast<void>(server_.moved.raise(i, 0.5));
              mine_.deliver();
            }),
            0u);
  EXPECT_EQ(client_.count, GetParam() ? 80 : 64) << "16 wait in the queue of another thread";
}

INSTANTIATE_TEST_SUITE_P(Threads, CallsInRealTime, testing::Values(true, false),
                         [](const auto& test) { return test.param ? "One" : "Two"; });

// --- life ----------------------------------------------------------------------------------------

class Lively : public Component {
 public:
  using Component::Component;
  using Component::error;
  Property<Vector> gains{this, "gains", Vector(3), "one per joint", "", changeable_while_running};
  Trigger go{"go"};
  StateMachine machine{
      this, "mode", "turns",
      in_state("A", entering<&Lively::note>, during<&Lively::note>, on(go, to("B/D"))),
      in_state("B", leaving<&Lively::note>, on(go, to("A")), in_state("C"),
               in_state("D", when<&Lively::yes>(to("C"))))};

 private:
  void on_update() override {
    log_info("{} {} {} {}", 1, 2.5, "text", true);
    sum_ += gains().front();
  }
  void note() { go_count_ += static_cast<int>(machine.path().size()); }
  bool yes() { return true; }
  double sum_ = 0.0;
  int go_count_ = 0;
};

TEST(LifeInRealTime, UpdatesStateMachinesAndLogLinesAllocateNothing) {
  Lively component("lively");
  TestThread thread(component);
  rt::LogQueue log(4);
  thread.context.log = &log;
  start(component);
  types::Value gains = types::Value::of(Vector(3, 2.0));
  EXPECT_EQ(allocations_of([&] {
              thread.cycle();
              Host::update(component);
              EXPECT_EQ(component.go.raise(), TriggerStatus::kTaken);
              Host::update(component);
              EXPECT_EQ(component.go.raise(), TriggerStatus::kTaken);
              EXPECT_TRUE(component.machine.is_in("A"));
              component.gains.swap(gains);
              while (log.pop() != nullptr) {
              }
            }),
            0u);
  EXPECT_EQ(component.machine.transitions_taken(), 12u);
}

TEST(LifeInRealTime, ErrorsRecoveryStopsFaultsResetsAndStartsAllocateNothing) {
  Lively component("lively");
  TestThread thread(component);
  start(component);
  EXPECT_EQ(allocations_of([&] {
              component.error("following error");
              Host::update(component);
              EXPECT_TRUE(Host::recover(component));
              Host::stop(component);
              EXPECT_TRUE(Host::start(component));
              component.fault("motor");
              EXPECT_TRUE(Host::reset(component));
              EXPECT_TRUE(Host::start(component));
              component.stop_because("old data");
              EXPECT_TRUE(Host::activate(component));
              EXPECT_TRUE(Host::start(component));
            }),
            0u);
}

}  // namespace
}  // namespace armature::component
