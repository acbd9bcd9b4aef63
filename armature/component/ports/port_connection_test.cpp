// SPDX-License-Identifier: Apache-2.0
// FIFOs, fan-in, delays, and connections between threads; the threads are run by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

std::vector<int> read_all(InputPort<int>& in) {
  std::vector<int> values;
  while (true) {
    const Reading<int> reading = in.read();
    if (!reading.is_new()) return values;
    values.push_back(reading.value);
  }
}

// --- FIFOs: the same in one thread and across threads --------------------------------------------

class Fifo : public testing::TestWithParam<bool> {
 protected:
  void connect(const ConnectionPolicy& policy) {
    one_.add(writer_);
    (GetParam() ? one_ : other_).add(reader_);
    face(writer_.out).connect(face(reader_.in), policy);
  }
  Writer<int> writer_{"writer"};
  Reader<int> reader_{"reader"};
  TestThread one_;
  TestThread other_;
};

TEST_P(Fifo, KeepsEachValueInOrder) {
  connect(fifo(4));
  for (int i = 1; i <= 4; ++i) EXPECT_EQ(writer_.out.write(i), WriteStatus::kWritten);
  EXPECT_THAT(read_all(reader_.in), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(reader_.in.read().status, ReadStatus::kOld);
  EXPECT_EQ(reader_.in.read().value, 4);
}

TEST_P(Fifo, WhenFullARefusalIsAnAnswerToTheWriterAndCountedNotASuccess) {
  connect(fifo(2));
  EXPECT_EQ(writer_.out.write(1), WriteStatus::kWritten);
  EXPECT_EQ(writer_.out.write(2), WriteStatus::kWritten);
  EXPECT_EQ(writer_.out.write(3), WriteStatus::kFull);
  EXPECT_EQ(writer_.out.write(4), WriteStatus::kFull);
  EXPECT_EQ(face(writer_.out).counters().refused, 2u);
  EXPECT_THAT(read_all(reader_.in), ElementsAre(1, 2));
  EXPECT_EQ(writer_.out.write(5), WriteStatus::kWritten);
  EXPECT_THAT(read_all(reader_.in), ElementsAre(5));
  EXPECT_EQ(face(reader_.in).counters().missed, 2u) << "the reader knows as well";
}

TEST_P(Fifo, WhenFullDroppingTheOldestIsAnAnswerToTheWriterAndCounted) {
  connect(fifo(2, rt::WhenFull::kDropOldest));
  EXPECT_EQ(writer_.out.write(1), WriteStatus::kWritten);
  EXPECT_EQ(writer_.out.write(2), WriteStatus::kWritten);
  EXPECT_EQ(writer_.out.write(3), WriteStatus::kDropped);
  EXPECT_EQ(face(writer_.out).counters().dropped, 1u);
  EXPECT_THAT(read_all(reader_.in), ElementsAre(2, 3));
  EXPECT_EQ(face(reader_.in).counters().missed, 1u);
}

TEST_P(Fifo, AFullOneDoesNotKeepValuesFromOtherReaders) {
  connect(fifo(1));
  Reader<int> other("other");
  one_.add(other);
  face(writer_.out).connect(face(other.in), latest());
  writer_.out.write(1);
  EXPECT_EQ(writer_.out.write(2), WriteStatus::kFull);
  EXPECT_EQ(other.in.read().value, 2);
}

INSTANTIATE_TEST_SUITE_P(Threads, Fifo, testing::Values(true, false),
                         [](const auto& test) { return test.param ? "One" : "Two"; });

// --- several writers -----------------------------------------------------------------------------

TEST(FanIn, FourWritersOnOneInputLoseNothing) {
  TriggeredReader reader("reader", fan_in);
  TestThread thread(reader);
  std::vector<std::unique_ptr<Writer<int>>> writers;
  for (int i = 0; i < 4; ++i) {
    writers.push_back(std::make_unique<Writer<int>>("writer"));
    thread.add(*writers.back());
    face(writers.back()->out).connect(face(reader.in), latest());
  }
  start(reader);
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(writers[static_cast<std::size_t>(i)]->out.write(10 * round + i),
                WriteStatus::kWritten);
    }
  }
  EXPECT_THAT(reader.values, ElementsAre(0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23));
  EXPECT_EQ(face(reader.in).counters().missed, 0u);
}

TEST(FanIn, AReaderTakesTheWritersInTurn) {
  Writer<int> a("a");
  Writer<int> b("b");
  Reader<int> reader("reader", fan_in);
  TestThread thread(reader);
  TestThread other(a, b);
  face(a.out).connect(face(reader.in), fifo(4));
  face(b.out).connect(face(reader.in), fifo(4));
  a.out.write(1);
  a.out.write(2);
  a.out.write(3);
  b.out.write(10);
  EXPECT_THAT(read_all(reader.in), ElementsAre(1, 10, 2, 3)) << "a busy one starves nobody";
}

// --- one cycle of delay --------------------------------------------------------------------------

class Delay : public testing::Test {
 protected:
  Delay() : thread_(writer_, reader_) { face(writer_.out).connect(face(reader_.in), delayed()); }
  Writer<int> writer_{"writer"};
  Reader<int> reader_{"reader"};
  TestThread thread_;
};

TEST_F(Delay, AReaderBehindTheWriterReadsTheCycleBefore) {
  for (int i = 1; i <= 3; ++i) {
    thread_.cycle();
    writer_.out.write(i);
    const Reading<int> reading = reader_.in.read();
    EXPECT_EQ(reading.status, i == 1 ? ReadStatus::kNone : ReadStatus::kNew);
    EXPECT_EQ(reading.value, i - 1) << "0 before the first";
  }
  EXPECT_EQ(face(reader_.in).counters().missed, 0u);
}

TEST_F(Delay, AReaderBeforeTheWriterReadsTheSame) {
  for (int i = 1; i <= 3; ++i) {
    thread_.cycle();
    const Reading<int> reading = reader_.in.read();
    EXPECT_EQ(reading.status, i == 1 ? ReadStatus::kNone : ReadStatus::kNew);
    EXPECT_EQ(reading.value, i - 1) << "0 before the first";
    writer_.out.write(i);
  }
}

TEST_F(Delay, TheLastOfSeveralWritesInACycleIsRead) {
  thread_.cycle();
  writer_.out.write(1);
  writer_.out.write(2);
  EXPECT_EQ(reader_.in.read().status, ReadStatus::kNone);
  thread_.cycle();
  EXPECT_EQ(reader_.in.read().value, 2);
  EXPECT_EQ(face(reader_.in).counters().missed, 1u);
}

TEST_F(Delay, AHandlerRunsAtTheBeginningOfTheNextCycle) {
  TriggeredReader triggered("triggered");
  thread_.add(triggered);
  face(writer_.out).connect(face(triggered.in), delayed());
  start(triggered);
  thread_.cycle();
  writer_.out.write(1);
  thread_.deliver();
  EXPECT_THAT(triggered.values, ElementsAre()) << "not in the same cycle";
  thread_.cycle();
  EXPECT_THAT(triggered.values, ElementsAre(1));
  thread_.cycle();
  EXPECT_THAT(triggered.values, ElementsAre(1)) << "and only once";
}

TEST_F(Delay, ALoopOfHandlersTurnsOncePerCycle) {
  class Loop : public Component {
   public:
    using Component::Component;
    InputPort<int> in{this, "In", "its own output", "", on_data<&Loop::turn>};
    OutputPort<int> out{this, "Out", "to itself"};

   private:
    void turn(const int& value) { out.write(value + 1); }
  };
  Loop loop("loop");
  thread_.add(loop);
  face(loop.out).connect(face(loop.in), delayed());
  start(loop);
  thread_.cycle();
  loop.out.write(0);
  for (int i = 0; i < 5; ++i) thread_.cycle();
  EXPECT_EQ(loop.out.last(), 5);
}

// --- between threads -----------------------------------------------------------------------------

class TwoThreads : public testing::Test {
 protected:
  TwoThreads() : writers_(writer_), readers_(reader_, triggered_) {}
  Writer<int> writer_{"writer"};
  Reader<int> reader_{"reader"};
  TriggeredReader triggered_{"triggered"};
  TestThread writers_;
  TestThread readers_;
};

TEST_F(TwoThreads, AReadFindsTheNewestValueAndCountsTheOthers) {
  face(writer_.out).connect(face(reader_.in), latest());
  EXPECT_EQ(reader_.in.read().status, ReadStatus::kNone);
  writer_.out.write(1);
  writer_.out.write(2);
  writer_.out.write(3);
  const Reading<int> reading = reader_.in.read();
  EXPECT_EQ(reading.status, ReadStatus::kNew);
  EXPECT_EQ(reading.value, 3);
  EXPECT_EQ(face(reader_.in).counters().missed, 2u);
  EXPECT_EQ(reader_.in.read().status, ReadStatus::kOld);
}

TEST_F(TwoThreads, ASampleKeepsTheTimeOfTheWritersCycle) {
  face(writer_.out).connect(face(reader_.in), latest());
  writers_.cycle(std::chrono::microseconds(250));
  writer_.out.write(1);
  readers_.cycle(std::chrono::seconds(1));
  EXPECT_EQ(reader_.in.read().time, base::time_from_ns(250'000));
}

TEST_F(TwoThreads, AHandlerRunsInItsOwnThread) {
  face(writer_.out).connect(face(triggered_.in), latest());
  start(writer_, triggered_);
  writer_.out.write(1);
  EXPECT_THAT(triggered_.values, ElementsAre());
  EXPECT_FALSE(readers_.context.inbox.empty());
  EXPECT_TRUE(writers_.context.inbox.empty());
  readers_.deliver();
  EXPECT_THAT(triggered_.values, ElementsAre(1));
}

TEST_F(TwoThreads, ALatestValueTriggersOnceForWhatWasWrittenSinceTheLastTime) {
  face(writer_.out).connect(face(triggered_.in), latest());
  start(writer_, triggered_);
  writer_.out.write(1);
  writer_.out.write(2);
  readers_.deliver();
  EXPECT_THAT(triggered_.values, ElementsAre(2));
  EXPECT_EQ(face(triggered_.in).counters().missed, 1u);
}

TEST_F(TwoThreads, AFifoTriggersOncePerValueInOrder) {
  face(writer_.out).connect(face(triggered_.in), fifo(8));
  start(writer_, triggered_);
  for (int i = 1; i <= 5; ++i) writer_.out.write(i);
  readers_.deliver();
  EXPECT_THAT(triggered_.values, ElementsAre(1, 2, 3, 4, 5));
  writer_.out.write(6);
  readers_.deliver();
  EXPECT_THAT(triggered_.values, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(TwoThreads, MoreThanAHundredEventsVanishOnlyIfTheWriterIsTold) {
  face(writer_.out).connect(face(triggered_.in), fifo(300));
  start(writer_, triggered_);
  for (int i = 0; i < 300; ++i) ASSERT_EQ(writer_.out.write(i), WriteStatus::kWritten);
  EXPECT_EQ(writer_.out.write(300), WriteStatus::kFull);
  readers_.deliver();
  EXPECT_EQ(triggered_.values.size(), 300u);
  EXPECT_EQ(face(writer_.out).counters().refused, 1u);
}

TEST_F(TwoThreads, ReadingATriggeringPortTakesNothingFromItsHandler) {
  face(writer_.out).connect(face(triggered_.in), fifo(4));
  start(writer_, triggered_);
  writer_.out.write(1);
  EXPECT_EQ(triggered_.in.read().status, ReadStatus::kNone);
  readers_.deliver();
  EXPECT_THAT(triggered_.values, ElementsAre(1));
  EXPECT_EQ(triggered_.in.read().value, 1);
}

TEST_F(TwoThreads, AnEventThatComesDuringTheUpdateIsHandledInTheSameCycle) {
  face(writer_.out).connect(face(triggered_.in), fifo(4));
  start(writer_, triggered_);
  readers_.cycle();
  triggered_.in_update = [this] {
    writer_.out.write(1);
    EXPECT_THAT(triggered_.values, ElementsAre()) << "the update is not interrupted";
  };
  Host::update(triggered_);
  readers_.deliver();
  EXPECT_THAT(triggered_.values, ElementsAre(1));
  EXPECT_EQ(triggered_.updates, 1) << "the handler did not cause one more";
}

TEST_F(TwoThreads, AnExceptionInAHandlerLeavesTheThreadAndTheOthersAlive) {
  Writer<int> other_writer("other_writer");
  TriggeredReader other("other");
  writers_.add(other_writer);
  readers_.add(other);
  face(writer_.out).connect(face(triggered_.in), fifo(4));
  face(other_writer.out).connect(face(other.in), fifo(4));
  start(writer_, other_writer, triggered_, other);
  triggered_.then = [] { throw 42; };
  writer_.out.write(1);
  other_writer.out.write(2);
  writer_.out.write(3);
  readers_.deliver();
  EXPECT_EQ(triggered_.state(), State::kException);
  EXPECT_THAT(triggered_.values, ElementsAre(1));
  EXPECT_THAT(other.values, ElementsAre(2));
}

TEST_F(TwoThreads, VectorsOfAnotherSizeAreRefusedHereToo) {
  Writer<std::vector<double>> writer("vectors");
  Reader<std::vector<double>> reader("vectors");
  writers_.add(writer);
  readers_.add(reader);
  writer.out.set_sample({0.0, 0.0});
  face(writer.out).connect(face(reader.in), latest());
  EXPECT_EQ(writer.out.write({1.0}), WriteStatus::kWrongSize);
  EXPECT_EQ(writer.out.write({1.0, 2.0}), WriteStatus::kWritten);
  EXPECT_THAT(reader.in.read().value, ElementsAre(1.0, 2.0));
}

}  // namespace
}  // namespace armature::component
