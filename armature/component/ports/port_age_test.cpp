// SPDX-License-Identifier: Apache-2.0
// What an input does when its data is older than declared, or its writer is out of service.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;

/// Reads in each update what its input says.
class Follower : public Component {
 public:
  template <typename... Options>
  explicit Follower(std::string name, Options... options)
      : Component(std::move(name)), in(this, "Reference", "to follow", "rad", options...) {}
  InputPort<double> in;
  OutputPort<double> out{this, "Out", "passes it on"};
  std::vector<double> seen;
  std::vector<bool> usable;

 private:
  void on_update() override {
    const Reading<double> reading = in.read();
    seen.push_back(reading.value);
    usable.push_back(static_cast<bool>(reading));
  }
};

/// A writer and a follower, in one thread or in two.
class Age : public testing::TestWithParam<bool> {
 protected:
  template <typename... Options>
  Follower& follow(Options... options) {
    follower_ = std::make_unique<Follower>("follower", options...);
    thread_.context.supervisor = &supervisor_;
    thread_.add(*follower_);
    (GetParam() ? thread_ : other_).add(writer_);
    face(writer_.out).connect(face(follower_->in), latest());
    start(writer_, *follower_);
    return *follower_;
  }
  /// One cycle of both threads, the follower last.
  void cycle(base::Duration duration = milliseconds(1)) {
    other_.cycle(duration);
    thread_.cycle(duration);
  }
  void write_and_cycle(double value) {
    cycle();
    writer_.out.write(value);
    Host::update(*follower_);
  }

  Writer<double> writer_{"writer"};
  std::unique_ptr<Follower> follower_;
  TestSupervisor supervisor_;
  TestThread thread_;
  TestThread other_;
};

TEST_P(Age, FreshDataStaysUsableForever) {
  Follower& follower = follow(max_age(milliseconds(2)));
  for (int i = 0; i < 10; ++i) write_and_cycle(i);
  EXPECT_EQ(follower.state(), State::kRunning);
  EXPECT_THAT(follower.usable, testing::Each(true));
  EXPECT_EQ(face(follower.in).counters().stale, 0u);
}

TEST_P(Age, OlderThanDeclaredStopsTheComponentBeforeItsUpdate) {
  Follower& follower = follow(max_age(milliseconds(2)));
  write_and_cycle(1.0);
  for (int i = 0; i < 2; ++i) {
    cycle();
    Host::update(follower);
  }
  EXPECT_EQ(follower.state(), State::kRunning) << "exactly as old as declared";
  cycle();
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kStopped);
  EXPECT_EQ(follower.reason(), "input 'Reference': its data is older than declared");
  EXPECT_EQ(follower.seen.size(), 3u) << "the update did not run once more";
  EXPECT_EQ(face(follower.in).counters().stale, 1u);
  EXPECT_THAT(supervisor_.stopped, ElementsAre("follower"));
}

TEST_P(Age, FaultsIfThatIsDeclared) {
  Follower& follower = follow(max_age(milliseconds(2), Reaction::kFault));
  write_and_cycle(1.0);
  cycle(milliseconds(3));
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kException);
  EXPECT_EQ(follower.reason(), "input 'Reference': its data is older than declared");
  EXPECT_THAT(supervisor_.faulted, ElementsAre("follower"));
}

TEST_P(Age, HoldsTheLastValueMarkedAsStaleAndCountsEachTimeItBegins) {
  Follower& follower = follow(max_age(milliseconds(2), Reaction::kHold));
  write_and_cycle(1.0);
  cycle(milliseconds(3));
  Host::update(follower);
  cycle();
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kRunning);
  EXPECT_THAT(follower.seen, ElementsAre(1.0, 1.0, 1.0));
  EXPECT_THAT(follower.usable, ElementsAre(true, false, false));
  EXPECT_EQ(face(follower.in).counters().stale, 1u);
  write_and_cycle(2.0);
  EXPECT_TRUE(follower.usable.back());
  EXPECT_EQ(follower.seen.back(), 2.0);
  cycle(milliseconds(3));
  Host::update(follower);
  EXPECT_EQ(face(follower.in).counters().stale, 2u);
}

TEST_P(Age, ReadsZeroUntilThereIsFreshData) {
  Follower& follower = follow(max_age(milliseconds(2), Reaction::kZero));
  write_and_cycle(1.0);
  cycle(milliseconds(3));
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kRunning);
  write_and_cycle(2.0);
  EXPECT_THAT(follower.seen, ElementsAre(1.0, 0.0, 2.0));
  EXPECT_THAT(follower.usable, ElementsAre(true, false, true));
}

TEST_P(Age, DataThatNeverCameIsTooOldOnceTheTimeSinceTheStartIs) {
  Follower& follower = follow(max_age(milliseconds(2)));
  cycle(milliseconds(2));
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kRunning);
  cycle();
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kStopped);
}

TEST_P(Age, AfterARestartTheWriterGetsTheTimeAgainButOldDataIsStillMarked) {
  Follower& follower = follow(max_age(milliseconds(2)));
  write_and_cycle(1.0);
  cycle(milliseconds(10));
  Host::update(follower);
  ASSERT_EQ(follower.state(), State::kStopped);
  EXPECT_TRUE(Host::start(follower));
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kRunning);
  EXPECT_FALSE(follower.usable.back()) << "a command from before the stop moves nothing";
  write_and_cycle(2.0);
  EXPECT_TRUE(follower.usable.back());
  EXPECT_EQ(follower.state(), State::kRunning);
}

INSTANTIATE_TEST_SUITE_P(Threads, Age, testing::Values(true, false),
                         [](const auto& test) { return test.param ? "One" : "Two"; });

TEST(AgeOfHandlers, OldDataStopsTheComponentBeforeAHandlerOfAnotherPortRuns) {
  class Mux : public Component {
   public:
    using Component::Component;
    InputPort<int> slow{this, "Slow", "ages", "", max_age(milliseconds(2))};
    InputPort<int> fast{this, "Fast", "triggers", "", on_data<&Mux::take>};
    int taken = 0;

   private:
    void take() { ++taken; }
  };
  Writer<int> slow("slow");
  Writer<int> fast("fast");
  Mux mux("mux");
  TestThread thread(slow, fast, mux);
  face(slow.out).connect(face(mux.slow), latest());
  face(fast.out).connect(face(mux.fast), latest());
  start(mux);
  for (int i = 0; i < 3; ++i) {
    fast.out.write(i);
    thread.cycle();
  }
  EXPECT_EQ(mux.taken, 3);
  fast.out.write(3);
  EXPECT_EQ(mux.taken, 3);
  EXPECT_EQ(mux.state(), State::kStopped);
}

TEST(AgeOfHandlers, AValueThatIsOldOnArrivalDoesNotReachItsHandler) {
  Writer<int> writer("writer");
  TriggeredReader reader("reader", max_age(milliseconds(2), Reaction::kFault));
  TestThread mine(reader);
  TestThread theirs(writer);
  face(writer.out).connect(face(reader.in), fifo(4));
  start(writer, reader);
  writer.out.write(1);
  mine.cycle(milliseconds(1));
  EXPECT_THAT(reader.values, ElementsAre(1));
  writer.out.write(2);
  mine.cycle(milliseconds(5));
  EXPECT_THAT(reader.values, ElementsAre(1));
  EXPECT_EQ(reader.state(), State::kException);
}

TEST(AgeOfHandlers, AHandlerIsGivenZeroInPlaceOfAnOldValueIfThatIsDeclared) {
  Writer<int> writer("writer");
  TriggeredReader reader("reader", max_age(milliseconds(2), Reaction::kZero));
  TestThread mine(reader);
  TestThread theirs(writer);
  face(writer.out).connect(face(reader.in), fifo(4));
  start(writer, reader);
  writer.out.write(7);
  mine.cycle(milliseconds(5));
  EXPECT_THAT(reader.values, ElementsAre(0));
  EXPECT_EQ(face(reader.in).counters().stale, 1u);
}

TEST(AgeOfFifos, LookingAtTheAgeTakesNoValueFromTheReader) {
  Writer<int> writer("writer");
  Reader<int> reader("reader", max_age(milliseconds(5)));
  TestThread mine(reader);
  TestThread theirs(writer);
  face(writer.out).connect(face(reader.in), fifo(4));
  start(writer, reader);
  for (int i = 1; i <= 3; ++i) writer.out.write(i);
  mine.cycle();
  EXPECT_TRUE(Host::admits(reader));
  EXPECT_EQ(reader.in.read().value, 1);
  mine.cycle();
  EXPECT_TRUE(Host::admits(reader));
  mine.cycle();
  EXPECT_TRUE(Host::admits(reader));
  EXPECT_EQ(reader.in.read().value, 2);
  EXPECT_EQ(reader.in.read().value, 3);
  EXPECT_EQ(face(reader.in).counters().missed, 0u);
}

TEST(AgeOfOpenPorts, APortThatMayStayOpenAndDoesHasNoAge) {
  Reader<int> reader("reader", may_stay_open, max_age(milliseconds(1)));
  TestThread thread(reader);
  start(reader);
  thread.cycle(milliseconds(10));
  EXPECT_TRUE(Host::admits(reader));
  EXPECT_EQ(reader.state(), State::kRunning);
}

TEST(AgeOfOpenPorts, ThatAreConnectedWhileTheComponentRunsIsLookedAtFromThenOn) {
  TestThread thread;
  Writer<double> writer("writer");
  Follower follower("follower", max_age(milliseconds(10)), may_stay_open);
  thread.add(writer);
  thread.add(follower);
  start(writer, follower);
  thread.cycle(milliseconds(100));
  Host::update(follower);
  ASSERT_EQ(follower.state(), State::kRunning);
  face(writer.out).connect(face(follower.in), latest());
  writer.out.write(1.0);
  Host::update(follower);
  thread.cycle(milliseconds(11));
  Host::update(follower);
  EXPECT_EQ(follower.state(), State::kStopped);
}

TEST(AgeFromOutside, ADeploymentMayDeclareTheAgeOfAConnection) {
  Writer<int> writer("writer");
  Reader<int> reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  face(reader.in).set_max_age(max_age(milliseconds(1), Reaction::kFault));
  start(reader);
  EXPECT_TRUE(Host::has_aging_inputs(reader));
  thread.cycle(milliseconds(2));
  EXPECT_FALSE(Host::admits(reader));
  EXPECT_EQ(reader.state(), State::kException);
}

// --- a writer out of service ---------------------------------------------------------------------

class Lost : public Age {};

TEST_P(Lost, AFaultOfTheWriterStopsItsReadersUnlessTheyDeclareOtherwise) {
  Follower& follower = follow();
  write_and_cycle(1.0);
  writer_.fault("for the test");
  cycle();
  EXPECT_EQ(follower.state(), State::kStopped);
  EXPECT_EQ(follower.reason(), "input 'Reference': the component that writes it is out of service");
  EXPECT_EQ(face(follower.in).counters().lost, 1u);
  EXPECT_THAT(supervisor_.stopped, ElementsAre("follower"));
}

TEST_P(Lost, HoldsZeroesOrFaultsAsDeclared) {
  for (const Reaction reaction : {Reaction::kHold, Reaction::kZero, Reaction::kFault}) {
    Writer<double> writer("writer");
    Follower follower("follower", on_lost(reaction));
    thread_.add(follower);
    (GetParam() ? thread_ : other_).add(writer);
    face(writer.out).connect(face(follower.in), latest());
    start(writer, follower);
    writer.out.write(1.0);
    Host::update(follower);
    writer.fault("for the test");
    cycle();
    Host::update(follower);
    EXPECT_EQ(follower.state(), reaction == Reaction::kFault ? State::kException : State::kRunning);
    if (reaction == Reaction::kFault) continue;
    EXPECT_EQ(follower.seen.back(), reaction == Reaction::kHold ? 1.0 : 0.0);
    ASSERT_TRUE(Host::reset(writer));
    ASSERT_TRUE(Host::start(writer));
    writer.out.write(3.0);
    Host::update(follower);
    EXPECT_EQ(follower.seen.back(), 3.0) << "the next value ends it";
  }
}

TEST_P(Lost, TheLossGoesOnDownTheChain) {
  Follower& middle = follow();
  Follower last("last");
  Follower holds("holds", on_lost(Reaction::kHold));
  thread_.add(last);
  other_.add(holds);
  face(middle.out).connect(face(last.in), latest());
  face(middle.out).connect(face(holds.in), latest());
  start(last, holds);
  writer_.fault("for the test");
  for (int i = 0; i < 3; ++i) cycle();
  EXPECT_EQ(middle.state(), State::kStopped);
  EXPECT_EQ(last.state(), State::kStopped);
  EXPECT_EQ(holds.state(), State::kRunning);
  EXPECT_EQ(face(holds.in).counters().lost, 1u);
}

TEST_P(Lost, AnExceptionInTheWriterIsALossAnOrderedStopIsNone) {
  Follower& follower = follow();
  Host::stop(writer_);
  cycle();
  EXPECT_EQ(follower.state(), State::kRunning);
  ASSERT_TRUE(Host::start(writer_));
  Host::run(writer_, Host::context(writer_), [] { throw 1; });
  cycle();
  EXPECT_EQ(follower.state(), State::kStopped);
}

TEST_P(Lost, AfterTheWriterCameBackTheReaderStartsAgain) {
  Follower& follower = follow();
  writer_.fault("for the test");
  cycle();
  ASSERT_EQ(follower.state(), State::kStopped);
  ASSERT_TRUE(Host::reset(writer_));
  ASSERT_TRUE(Host::start(writer_));
  ASSERT_TRUE(Host::start(follower));
  write_and_cycle(2.0);
  EXPECT_EQ(follower.state(), State::kRunning);
  EXPECT_EQ(follower.reason(), "");
  EXPECT_EQ(follower.seen.back(), 2.0);
  writer_.fault("again");
  cycle();
  EXPECT_EQ(follower.state(), State::kStopped) << "and is told again";
}

TEST_P(Lost, ALossThatWasNotDeliveredWhenTheThreadsEndedIsForgotten) {
  Follower& follower = follow();
  writer_.fault("for the test");
  TestThread next;
  next.add(writer_, follower);
  ASSERT_TRUE(Host::reset(writer_));
  ASSERT_TRUE(Host::start(writer_));
  next.cycle();
  EXPECT_EQ(follower.state(), State::kRunning);
  writer_.fault("again");
  next.cycle();
  EXPECT_EQ(follower.state(), State::kStopped);
}

INSTANTIATE_TEST_SUITE_P(Threads, Lost, testing::Values(true, false),
                         [](const auto& test) { return test.param ? "One" : "Two"; });

}  // namespace
}  // namespace armature::component
