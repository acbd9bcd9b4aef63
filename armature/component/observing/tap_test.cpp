// SPDX-License-Identifier: Apache-2.0
#include "armature/component/observing/tap.hpp"

#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/observing/tap.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;
using testing::Pair;

struct Pose {
  double x = 0.0;
  int turns = 0;
  bool operator==(const Pose&) const = default;
};
ARMATURE_STRUCT(Pose, x, turns);

class Source final : public Component {
 public:
  using Component::Component;
  OutputPort<double> number{this, "Number", ""};
  OutputPort<std::vector<double>> vector{this, "Vector", "", "", fixed_size(2)};
  OutputPort<Pose> pose{this, "Pose", ""};
  Property<int> count{this, "Count", 2, ""};
  Property<std::string> text{this, "Text", "first", ""};
  Attribute<int> attribute{this, "Attribute", 7, ""};
  OutputPorts<double> ports{this, "Port", count, ""};
};

class Sink final : public Component {
 public:
  using Component::Component;
  int handled = 0;
  InputPort<double> latest{this, "Latest", ""};
  InputPort<double> triggering{this, "Triggering", "", "", on_data<&Sink::handle>};

 private:
  void handle(double) { ++handled; }
};

template <typename T>
T value_of(const TappedSample& sample) {
  types::Value value(types::type_of<T>());
  EXPECT_TRUE(types::decode(value.type(), sample.value.data(), sample.value.size(), value.data()));
  return *value.get_if<T>();
}

/// (sequence, value) of all that is there.
template <typename T>
std::vector<std::pair<std::uint64_t, T>> take_all(Tap& tap) {
  std::vector<std::pair<std::uint64_t, T>> all;
  TappedSample sample;
  while (tap.take(sample)) all.emplace_back(sample.sequence, value_of<T>(sample));
  return all;
}

class Taps : public testing::Test {
 protected:
  void SetUp() override {
    Host::assign_context(source, here);
    Host::assign_context(sink, here);
    ASSERT_TRUE(Host::configure(source));
    ASSERT_TRUE(Host::configure(sink));
    ASSERT_TRUE(Host::start(sink));
    face(source.vector).prepare();
  }
  ExecutionContext here{"here"};
  Source source{"source"};
  Sink sink{"sink"};
};

TEST_F(Taps, EverySampleComesWithItsTimeAndNumber) {
  Tap& tap = face(source.number).tap(4);
  here.cycle_time = base::time_from_ns(10);
  source.number.write(0.5);
  here.cycle_time = base::time_from_ns(20);
  source.number.write(1.5);
  TappedSample sample;
  ASSERT_TRUE(tap.take(sample));
  EXPECT_EQ(base::to_ns(sample.time), 10);
  EXPECT_EQ(sample.sequence, 1u);
  EXPECT_EQ(value_of<double>(sample), 0.5);
  ASSERT_TRUE(tap.take(sample));
  EXPECT_EQ(base::to_ns(sample.time), 20);
  EXPECT_EQ(value_of<double>(sample), 1.5);
  EXPECT_FALSE(tap.take(sample));
}

TEST_F(Taps, VectorsAndStructsComeAsTheyWere) {
  Tap& vector = face(source.vector).tap(4);
  Tap& pose = face(source.pose).tap(4);
  source.vector.write({1.0, -2.0});
  source.vector.write({1.0, 2.0, 3.0});  // of another size: not written
  source.pose.write({0.5, -3});
  EXPECT_THAT(take_all<std::vector<double>>(vector),
              ElementsAre(Pair(1u, std::vector<double>{1.0, -2.0})));
  EXPECT_THAT(take_all<Pose>(pose), ElementsAre(Pair(1u, Pose{0.5, -3})));
}

TEST_F(Taps, OfEveryThirdSampleTheFirstIsTaken) {
  Tap& tap = face(source.number).tap(4, 3);
  for (int i = 1; i <= 8; ++i) source.number.write(i);
  EXPECT_THAT(take_all<double>(tap), ElementsAre(Pair(1u, 1.0), Pair(4u, 4.0), Pair(7u, 7.0)));
  EXPECT_EQ(tap.dropped(), 0u);
}

TEST_F(Taps, WhatFindsNoRoomIsDroppedCountedAndAGap) {
  Tap& tap = face(source.number).tap(2);
  for (int i = 1; i <= 5; ++i) source.number.write(i);
  EXPECT_EQ(tap.dropped(), 3u);
  EXPECT_THAT(take_all<double>(tap), ElementsAre(Pair(1u, 1.0), Pair(2u, 2.0)));
  source.number.write(6.0);
  EXPECT_THAT(take_all<double>(tap), ElementsAre(Pair(6u, 6.0)));
  EXPECT_EQ(tap.dropped(), 3u);
}

TEST_F(Taps, AWriterIsToldWhatItIsToldWithoutTaps) {
  face(source.number).tap(1);
  EXPECT_EQ(source.number.write(1.0), WriteStatus::kNotConnected);
  EXPECT_EQ(source.number.write(2.0), WriteStatus::kNotConnected);
  face(source.number).connect(face(sink.latest), {});
  EXPECT_EQ(source.number.write(3.0), WriteStatus::kWritten);
  EXPECT_EQ(face(source.number).counters().refused, 0u);
  EXPECT_TRUE(sink.latest.read().is_new());
}

TEST_F(Taps, HandlersRunAndReadersReadAsWithoutTaps) {
  face(source.number).connect(face(sink.triggering), {});
  face(source.number).connect(face(sink.latest), {ConnectionPolicy::Kind::kFifo, 1});
  Tap& tap = face(source.number).tap(8);
  EXPECT_EQ(source.number.write(1.0), WriteStatus::kWritten);
  EXPECT_EQ(source.number.write(2.0), WriteStatus::kFull);
  EXPECT_EQ(sink.handled, 2);
  EXPECT_EQ(sink.latest.read().value, 1.0);
  EXPECT_EQ(take_all<double>(tap).size(), 2u);
}

TEST_F(Taps, SeveralTapsOfAPortEachGetEverySample) {
  Tap& first = face(source.number).tap(4);
  Tap& second = face(source.number).tap(1);
  source.number.write(1.0);
  source.number.write(2.0);
  EXPECT_EQ(take_all<double>(first).size(), 2u);
  EXPECT_EQ(take_all<double>(second).size(), 1u);
  EXPECT_EQ(second.dropped(), 1u);
}

TEST_F(Taps, AreGoneWhenThePortIsDisconnected) {
  face(source.number).tap(4);
  EXPECT_TRUE(face(source.number).is_tapped());
  face(source.number).disconnect_all();
  EXPECT_FALSE(face(source.number).is_tapped());
  EXPECT_EQ(source.number.write(1.0), WriteStatus::kNotConnected);
}

TEST_F(Taps, APortOfAFamilyStaysWhileItIsTapped) {
  face(source.ports[1]).tap(4);
  const auto changed = source.count.set(types::Value::of(1));
  ASSERT_FALSE(changed);
  EXPECT_THAT(changed.error(), testing::HasSubstr("'Port2'"));
  face(source.ports[1]).disconnect_all();
  EXPECT_TRUE(source.count.set(types::Value::of(1)));
}

TEST_F(Taps, EverySampleArrivesInOrderFromAnotherThread) {
  constexpr int kSamples = 20'000;
  Tap& tap = face(source.number).tap(16);
  std::thread writer([this] {
    for (int i = 1; i <= kSamples; ++i) source.number.write(i);
  });
  std::uint64_t taken = 0;
  std::uint64_t last = 0;
  TappedSample sample;
  const auto take = [&] {
    while (tap.take(sample)) {
      ++taken;
      ASSERT_GT(sample.sequence, last);
      last = sample.sequence;
      ASSERT_EQ(value_of<double>(sample), static_cast<double>(last));
    }
  };
  while (taken + tap.dropped() < kSamples) take();
  writer.join();
  take();
  EXPECT_EQ(taken + tap.dropped(), static_cast<std::uint64_t>(kSamples));
}

TEST_F(Taps, APropertyGivesItsPresentValueAndEveryChange) {
  here.cycle_time = base::time_from_ns(5);
  Tap& tap = source.attribute.tap(4);
  here.cycle_time = base::time_from_ns(10);
  source.attribute.assign(8);
  source.attribute.assign(8);  // no change
  TappedSample sample;
  ASSERT_TRUE(tap.take(sample));
  EXPECT_EQ(base::to_ns(sample.time), 5);
  EXPECT_EQ(value_of<int>(sample), 7);
  ASSERT_TRUE(tap.take(sample));
  EXPECT_EQ(base::to_ns(sample.time), 10);
  EXPECT_EQ(value_of<int>(sample), 8);
  EXPECT_FALSE(tap.take(sample));
  EXPECT_EQ(tap.dropped(), 0u);
}

TEST_F(Taps, APropertyThatIsSetFromOutsideIsSeenToo) {
  Tap& tap = source.text.tap(4);
  ASSERT_TRUE(source.text.set(types::Value::of(std::string("second"))));
  EXPECT_THAT(take_all<std::string>(tap), ElementsAre(Pair(1u, "first"), Pair(2u, "second")));
}

TEST_F(Taps, OfTooManyChangesOfAPropertyTheNewestStay) {
  Tap& tap = source.attribute.tap(2);
  for (int i = 0; i < 5; ++i) source.attribute.assign(i);
  EXPECT_THAT(take_all<int>(tap), ElementsAre(Pair(5u, 3), Pair(6u, 4)));
  EXPECT_EQ(tap.dropped(), 4u);
}

TEST_F(Taps, ATextThatBecomesTooLongCountsAsDropped) {
  Tap& tap = source.text.tap(4);
  source.text.assign(std::string(1000, 'x'));
  source.text.assign("first");
  EXPECT_THAT(take_all<std::string>(tap), ElementsAre(Pair(1u, "first"), Pair(3u, "first")));
  EXPECT_EQ(tap.dropped(), 1u);
}

TEST_F(Taps, ThoseOfAPropertyEndWhenTheyAreToldTo) {
  source.attribute.tap(1);
  source.attribute.untap();
  source.attribute.assign(1);
  Tap& again = source.attribute.tap(1);
  EXPECT_THAT(take_all<int>(again), ElementsAre(Pair(1u, 1)));
}

TEST(TapSizes, AnOutputPortIsAsSmallAsWithoutTaps) { EXPECT_EQ(sizeof(OutputPort<double>), 64u); }

}  // namespace
}  // namespace armature::component
