// SPDX-License-Identifier: Apache-2.0
// Ports within one thread.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

struct Pair {
  double position = 0.0;
  std::vector<float> history;
};
ARMATURE_STRUCT(Pair, position, history);

TEST(Port, AReadTellsNotConnectedNoneNewAndOldApart) {
  Writer<double> writer("writer");
  Reader<double> reader("reader");
  TestThread thread(writer, reader);
  EXPECT_EQ(reader.in.read().status, ReadStatus::kNotConnected);
  EXPECT_FALSE(reader.in.read());

  face(writer.out).connect(face(reader.in), latest());
  EXPECT_EQ(reader.in.read().status, ReadStatus::kNone);
  EXPECT_FALSE(reader.in.read());

  EXPECT_EQ(writer.out.write(0.5), WriteStatus::kWritten);
  const Reading<double> fresh = reader.in.read();
  EXPECT_EQ(fresh.status, ReadStatus::kNew);
  EXPECT_TRUE(fresh.is_new());
  EXPECT_TRUE(fresh);
  EXPECT_EQ(fresh.value, 0.5);

  const Reading<double> again = reader.in.read();
  EXPECT_EQ(again.status, ReadStatus::kOld);
  EXPECT_FALSE(again.is_new());
  EXPECT_TRUE(again);
  EXPECT_EQ(again.value, 0.5);
}

TEST(Port, AValueEqualToTheLastIsNewNevertheless) {
  Writer<double> writer("writer");
  Reader<double> reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  writer.out.write(0.5);
  EXPECT_TRUE(reader.in.read().is_new());
  writer.out.write(0.5);
  EXPECT_TRUE(reader.in.read().is_new());
}

TEST(Port, AWriteThatNobodyReadsSaysSoAndKeepsTheValueForTools) {
  Writer<double> writer("writer");
  TestThread thread(writer);
  EXPECT_EQ(writer.out.write(0.5), WriteStatus::kNotConnected);
  EXPECT_EQ(writer.out.last(), 0.5);
  EXPECT_EQ(*static_cast<const double*>(face(writer.out).current()), 0.5);
  EXPECT_EQ(face(writer.out).current_sequence(), 1u);
}

TEST(Port, ASampleHasTheCycleTimeOfItsWriteHoweverLateInTheCycle) {
  Writer<double> writer("writer");
  Reader<double> reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  thread.cycle();
  writer.out.write(1.0);
  thread.cycle();
  EXPECT_EQ(reader.in.read().time, base::time_from_ns(1'000'000));
}

TEST(Port, CountsTheValuesThatWereOverwrittenUnread) {
  Writer<double> writer("writer");
  Reader<double> reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  for (int i = 0; i < 5; ++i) writer.out.write(i);
  EXPECT_EQ(reader.in.read().value, 4.0);
  EXPECT_EQ(face(reader.in).counters().missed, 4u);
  writer.out.write(5.0);
  EXPECT_EQ(reader.in.read().value, 5.0);
  EXPECT_EQ(face(reader.in).counters().missed, 4u);
}

TEST(Port, OneWriterServesManyReaders) {
  Writer<double> writer("writer");
  Reader<double> a("a");
  Reader<double> b("b");
  TestThread thread(writer, a, b);
  face(writer.out).connect(face(a.in), latest());
  face(writer.out).connect(face(b.in), latest());
  writer.out.write(2.0);
  EXPECT_EQ(a.in.read().value, 2.0);
  EXPECT_EQ(a.in.read().status, ReadStatus::kOld);
  EXPECT_EQ(b.in.read().status, ReadStatus::kNew) << "each has its own view";
}

TEST(Port, AValueWrittenBeforeTheConnectionIsReadAsNewOverEveryKindOfConnection) {
  for (const ConnectionPolicy& policy : {latest(), fifo(3)}) {
    for (const bool same_thread : {true, false}) {
      Writer<int> writer("writer");
      Reader<int> reader("reader");
      TestThread one(writer);
      TestThread other;
      (same_thread ? one : other).add(reader);
      writer.out.write(6);
      writer.out.write(7);
      face(writer.out).connect(face(reader.in), policy);
      const Reading<int> reading = reader.in.read();
      EXPECT_EQ(reading.status, ReadStatus::kNew);
      EXPECT_EQ(reading.value, 7);
      EXPECT_EQ(reader.in.read().status, ReadStatus::kOld);
      EXPECT_EQ(face(reader.in).counters().missed, 0u);
    }
  }
}

TEST(Port, BeforeTheFirstWriteAnInputHoldsZerosInTheShapeOfItsWriter) {
  Writer<std::vector<double>> writer("writer");
  Reader<std::vector<double>> reader("reader");
  TestThread thread(writer, reader);
  writer.out.set_sample({1.0, 2.0});
  face(writer.out).connect(face(reader.in), latest());
  const auto reading = reader.in.read();
  EXPECT_EQ(reading.status, ReadStatus::kNone);
  EXPECT_THAT(reading.value, ElementsAre(0.0, 0.0));
}

TEST(Port, ZerosReachEveryPartOfAStruct) {
  Writer<Pair> writer("writer");
  Reader<Pair> reader("reader");
  TestThread thread(writer, reader);
  writer.out.set_sample({1.0, {2.0f, 3.0f}});
  face(writer.out).connect(face(reader.in), latest());
  EXPECT_EQ(reader.in.read().value.position, 0.0);
  EXPECT_THAT(reader.in.read().value.history, ElementsAre(0.0f, 0.0f));
}

// --- sizes of vectors ----------------------------------------------------------------------------

class VectorWriter : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 2, "number of joints"};
  OutputPort<std::vector<double>> out{this, "Out", "one per joint", "rad", size_of(joints, 3)};
  InputPort<std::vector<double>> in{this, "In", "one per joint", "rad", size_of(joints)};
};

/// Serves any unit.
class AnyUnit : public Component {
 public:
  using Component::Component;
  Property<std::string> unit{this, "Unit", "rad", "of the ports"};
  OutputPort<double> out{this, "Out", "a number", "", unit_of(unit)};
  InputPort<double> in{this, "In", "a number", "", unit_of(unit)};
};

TEST(Port, HasTheUnitThatAPropertySays) {
  AnyUnit component("any");
  EXPECT_EQ(face(component.out).unit(), "rad");
  ASSERT_TRUE(component.unit.set(types::Value::of(std::string("a unit with a long name"))));
  EXPECT_EQ(face(component.out).unit(), "a unit with a long name");
  EXPECT_EQ(face(component.in).unit(), "a unit with a long name");
}

TEST(VectorPort, TakesItsSizeFromAProperty) {
  VectorWriter component("vectors");
  TestThread thread(component);
  ASSERT_TRUE(component.joints.set(types::Value::of(4)));
  face(component.out).prepare();
  EXPECT_EQ(component.out.last().size(), 12u);
  EXPECT_EQ(face(component.in).declared_size().value(), 4u);
}

TEST(VectorPort, AWrongSizeIsRefusedAndCountedAndNothingIsWritten) {
  VectorWriter writer("writer");
  Reader<std::vector<double>> reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).prepare();
  face(writer.out).connect(face(reader.in), latest());
  EXPECT_EQ(writer.out.write({1, 2, 3, 4, 5}), WriteStatus::kWrongSize);
  EXPECT_EQ(writer.out.write({1, 2, 3, 4, 5, 6, 7}), WriteStatus::kWrongSize);
  EXPECT_EQ(face(writer.out).counters().wrong_size, 2u);
  EXPECT_EQ(reader.in.read().status, ReadStatus::kNone);
  EXPECT_EQ(writer.out.write({1, 2, 3, 4, 5, 6}), WriteStatus::kWritten);
  EXPECT_THAT(reader.in.read().value, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(VectorPort, AWrongSizeInsideAStructIsRefusedToo) {
  Writer<Pair> writer("writer");
  TestThread thread(writer);
  writer.out.set_sample({0.0, {0.0f, 0.0f}});
  EXPECT_EQ(writer.out.write({1.0, {1.0f}}), WriteStatus::kWrongSize);
  EXPECT_EQ(writer.out.write({1.0, {1.0f, 2.0f}}), WriteStatus::kNotConnected);
}

TEST(VectorPort, SizesThatDoNotFitAreKnownBeforeConnecting) {
  VectorWriter writer("writer");
  VectorWriter reader("reader");
  face(writer.out).prepare();
  EXPECT_FALSE(face(writer.out).fits(face(reader.in))) << "6 elements for 2";
  ASSERT_TRUE(reader.joints.set(types::Value::of(6)));
  EXPECT_TRUE(face(writer.out).fits(face(reader.in)));
}

// --- triggers ------------------------------------------------------------------------------------

TEST(Trigger, AHandlerRunsOncePerEventInOrderAndWithinTheWrite) {
  Writer<int> writer("writer");
  TriggeredReader reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  start(writer, reader);
  for (int i = 1; i <= 3; ++i) {
    writer.out.write(i);
    EXPECT_EQ(reader.values.size(), static_cast<std::size_t>(i));
  }
  EXPECT_THAT(reader.values, ElementsAre(1, 2, 3));
}

TEST(Trigger, NeitherAHandlerNorAMessageRunsTheUpdateHook) {
  Writer<int> writer("writer");
  TriggeredReader reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  start(writer, reader);
  writer.out.write(1);
  thread.cycle();
  EXPECT_EQ(reader.updates, 0);
}

class UpdatedByData : public ProbeComponent {
 public:
  using ProbeComponent::ProbeComponent;
  InputPort<int> in{this, "In", "triggers the update", "", on_data_update};
};

TEST(Trigger, OnDataUpdateRunsTheUpdateOncePerWrite) {
  Writer<int> writer("writer");
  UpdatedByData reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  start(writer, reader);
  reader.calls.clear();
  writer.out.write(1);
  writer.out.write(2);
  EXPECT_THAT(reader.calls, ElementsAre("update", "update"));
}

TEST(Trigger, OnDataUpdateRunsTheErrorHookWhileThereIsARunTimeError) {
  Writer<int> writer("writer");
  UpdatedByData reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  start(writer, reader);
  reader.error("for the test");
  reader.calls.clear();
  writer.out.write(1);
  EXPECT_THAT(reader.calls, ElementsAre("error"));
}

TEST(Trigger, WhatArrivesWhileTheComponentDoesNotRunTriggersNothingAndCanBeReadLater) {
  Writer<int> writer("writer");
  TriggeredReader reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  writer.out.write(1);
  start(writer, reader);
  EXPECT_THAT(reader.values, ElementsAre());
  EXPECT_EQ(reader.in.read().status, ReadStatus::kNew);
  EXPECT_EQ(reader.in.read().value, 1);
  Host::stop(reader);
  writer.out.write(2);
  EXPECT_THAT(reader.values, ElementsAre());
}

class AllHandlers : public Component {
 public:
  using Component::Component;
  Property<int> count{this, "count", 2, "ports"};
  InputPort<int> plain{this, "Plain", "handler without arguments", "",
                       on_data<&AllHandlers::touch>};
  InputPorts<int> several{
      this, "Each", count, "handler with index", "", on_data<&AllHandlers::take>};
  std::vector<std::pair<std::size_t, int>> taken;
  int touched = 0;

 private:
  void touch() { touched += plain.read().value; }
  void take(std::size_t index, int value) { taken.emplace_back(index, value); }
};

TEST(Trigger, AHandlerTakesNothingOrTheValueOrIndexAndValue) {
  Writer<int> a("a");
  Writer<int> b("b");
  AllHandlers reader("reader");
  TestThread thread(a, b, reader);
  face(a.out).connect(face(reader.plain), latest());
  face(a.out).connect(face(reader.several[0]), latest());
  face(b.out).connect(face(reader.several[1]), latest());
  start(a, b, reader);
  a.out.write(5);
  b.out.write(6);
  EXPECT_EQ(reader.touched, 5);
  EXPECT_THAT(reader.taken, ElementsAre(testing::Pair(0u, 5), testing::Pair(1u, 6)));
}

TEST(Trigger, AnExceptionInAHandlerBelongsToTheReceiverAndTheWriterGoesOn) {
  Writer<int> writer("writer");
  TriggeredReader broken("broken");
  TriggeredReader healthy("healthy");
  TestThread thread(writer, broken, healthy);
  face(writer.out).connect(face(broken.in), latest());
  face(writer.out).connect(face(healthy.in), latest());
  start(writer, broken, healthy);
  broken.then = [] { throw std::runtime_error("cannot take it"); };

  EXPECT_EQ(writer.out.write(1), WriteStatus::kWritten);
  EXPECT_EQ(broken.state(), State::kException);
  EXPECT_EQ(broken.reason(), "exception: cannot take it");
  EXPECT_EQ(writer.state(), State::kRunning);
  EXPECT_THAT(healthy.values, ElementsAre(1)) << "the other reader is served";

  EXPECT_EQ(writer.out.write(2), WriteStatus::kWritten);
  EXPECT_THAT(broken.values, ElementsAre(1)) << "nothing of a faulted component runs";
  EXPECT_THAT(healthy.values, ElementsAre(1, 2));
}

// --- connecting and disconnecting ----------------------------------------------------------------

TEST(Connection, APortForgetsItsPeersWhenTheyAreDestroyed) {
  Writer<int> writer("writer");
  Reader<int> reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  {
    Reader<int> passing("passing");
    thread.add(passing);
    face(writer.out).connect(face(passing.in), fifo(2));
    EXPECT_EQ(face(writer.out).readers().size(), 2u);
  }
  EXPECT_THAT(face(writer.out).readers(), ElementsAre(&face(reader.in)));
  EXPECT_EQ(writer.out.write(1), WriteStatus::kWritten);
  EXPECT_EQ(reader.in.read().value, 1);
}

TEST(Connection, AnInputForgetsAWriterThatIsDestroyed) {
  Reader<int> reader("reader", fan_in);
  TestThread thread(reader);
  Writer<int> stays("stays");
  {
    Writer<int> passing("passing");
    thread.add(stays, passing);
    face(passing.out).connect(face(reader.in), fifo(2));
    face(stays.out).connect(face(reader.in), fifo(2));
    passing.out.write(1);
    EXPECT_EQ(reader.in.read().value, 1);
  }
  EXPECT_THAT(face(reader.in).writers(), ElementsAre(&face(stays.out)));
  EXPECT_EQ(reader.in.read().status, ReadStatus::kNone);
  stays.out.write(2);
  EXPECT_EQ(reader.in.read().value, 2);
}

TEST(Connection, DisconnectingOneOfSeveralWritersLeavesTheOthers) {
  Writer<int> a("a");
  Writer<int> b("b");
  TriggeredReader reader("reader", fan_in);
  TestThread thread(a, b, reader);
  face(a.out).connect(face(reader.in), fifo(2));
  face(b.out).connect(face(reader.in), fifo(2));
  start(a, b, reader);
  face(a.out).disconnect_all();
  EXPECT_EQ(a.out.write(1), WriteStatus::kNotConnected);
  b.out.write(2);
  EXPECT_THAT(reader.values, ElementsAre(2));
}

TEST(Connection, AfterDisconnectingAnInputSaysThatItIsNotConnected) {
  Writer<int> writer("writer");
  Reader<int> reader("reader");
  TestThread thread(writer, reader);
  face(writer.out).connect(face(reader.in), latest());
  writer.out.write(1);
  face(writer.out).disconnect_all();
  EXPECT_EQ(reader.in.read().status, ReadStatus::kNotConnected);
  EXPECT_EQ(writer.out.write(2), WriteStatus::kNotConnected);
}

}  // namespace
}  // namespace armature::component
