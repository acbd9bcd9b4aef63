// SPDX-License-Identifier: Apache-2.0
// Writers of one input that take turns: one runs, the others do not.
#include <chrono>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::component {
namespace {

using namespace std::chrono_literals;

/// Two writers and a reader in one thread.
template <typename Reads>
class Turns {
 public:
  template <typename... Options>
  explicit Turns(Options... options) : reader("Reader", options...) {
    for (Component* each : {static_cast<Component*>(&a), static_cast<Component*>(&b),
                            static_cast<Component*>(&reader)}) {
      Host::assign_context(*each, context);
      EXPECT_TRUE(Host::configure(*each));
    }
    face(reader.in).let_writers_take_turns();
    face(a.out).connect(face(reader.in), latest());
    face(b.out).connect(face(reader.in), latest());
    EXPECT_TRUE(Host::start(a));
    EXPECT_TRUE(Host::start(reader));
  }
  ~Turns() {
    face(a.out).disconnect_all();
    face(b.out).disconnect_all();
  }
  void at(base::Duration time) { context.cycle_time = base::Time{} + time; }

  ExecutionContext context{"thread"};
  Writer<int> a{"A"};
  Writer<int> b{"B"};
  Reads reader;
};

TEST(Turns, AHandlerRunsForWhoeverWrites) {
  Turns<TriggeredReader> turns;
  turns.a.out.write(1);
  Host::stop(turns.a);
  EXPECT_TRUE(Host::start(turns.b));
  turns.b.out.write(2);
  turns.b.out.write(3);
  EXPECT_EQ(turns.reader.values, (std::vector<int>{1, 2, 3}));
}

TEST(Turns, WhatTheLastOneWroteStaysUntilTheNextOneWrites) {
  Turns<Reader<int>> turns;
  turns.a.out.write(1);
  EXPECT_EQ(turns.reader.in.read().value, 1);
  Host::stop(turns.a);
  EXPECT_TRUE(Host::start(turns.b));
  const auto held = turns.reader.in.read();
  EXPECT_EQ(held.status, ReadStatus::kOld);
  EXPECT_EQ(held.value, 1);
  turns.b.out.write(2);
  EXPECT_EQ(turns.reader.in.read().value, 2);
}

TEST(Turns, WhatNobodyReadOfTheLastOneDoesNotComeAfterTheNext) {
  for (const bool first_to_second : {true, false}) {
    Turns<Reader<int>> turns;
    Writer<int>& last = first_to_second ? turns.a : turns.b;
    Writer<int>& next = first_to_second ? turns.b : turns.a;
    turns.at(10ms);
    last.out.write(1);
    turns.at(20ms);
    next.out.write(2);
    EXPECT_EQ(turns.reader.in.read().value, 2);
    const auto again = turns.reader.in.read();
    EXPECT_EQ(again.status, ReadStatus::kOld);
    EXPECT_EQ(again.value, 2);
  }
}

TEST(Turns, AgeGoesOnFromTheLastOne) {
  Turns<Reader<int>> turns(max_age(30ms));
  turns.at(10ms);
  turns.a.out.write(1);
  Host::stop(turns.a);
  EXPECT_TRUE(Host::start(turns.b));
  turns.at(40ms);
  EXPECT_TRUE(Host::admits(turns.reader)) << "30 ms old";
  turns.b.out.write(2);
  turns.at(70ms);
  EXPECT_TRUE(Host::admits(turns.reader));
  turns.at(71ms);
  EXPECT_FALSE(Host::admits(turns.reader));
}

TEST(Turns, OnlyTheLossOfTheOneWhoseTurnItIsCounts) {
  Turns<Reader<int>> turns;
  EXPECT_TRUE(Host::start(turns.b));
  turns.b.fault("broken");
  turns.context.inbox.deliver_all();
  EXPECT_EQ(turns.reader.state(), State::kRunning);
  turns.a.fault("broken");
  turns.context.inbox.deliver_all();
  EXPECT_EQ(turns.reader.state(), State::kStopped);
}

TEST(Turns, APortKnowsWhatItTakesOverAsLongAsItIsSaid) {
  Turns<Reader<int>> turns;
  turns.a.out.write(7);
  EXPECT_EQ(turns.b.out.taken_over(), nullptr);
  face(turns.b.out).take_over_from(&face(turns.a.out));
  ASSERT_NE(turns.b.out.taken_over(), nullptr);
  EXPECT_EQ(*turns.b.out.taken_over(), 7);
  face(turns.b.out).take_over_from(nullptr);
  EXPECT_EQ(turns.b.out.taken_over(), nullptr);
}

}  // namespace
}  // namespace armature::component
