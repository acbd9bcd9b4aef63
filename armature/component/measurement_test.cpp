// SPDX-License-Identifier: Apache-2.0
// Execution times of components: each one's own, without what it called.
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/rt/statistics.hpp"
#include "armature/rt/ticks.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

/// Keeps the processor busy for at least `duration` ticks and returns how many it were.
std::uint64_t work(std::uint64_t duration) {
  const std::uint64_t begin = rt::ticks();
  std::uint64_t now = begin;
  while (now - begin < duration) now = rt::ticks();
  return now - begin;
}

constexpr std::uint64_t kLong = 200'000;

class Worker : public Component {
 public:
  using Component::Component;
  OutputPort<int> out{this, "Out", "triggers the next"};
  InputPort<int> in{this, "In", "triggers this", "", on_data<&Worker::take>};
  Operation<void()> work_here{this, "work", serve<&Worker::take_call>, "in the caller's thread"};
  std::uint64_t duration = 0;
  std::uint64_t worked = 0;

 private:
  void on_update() override {
    worked += work(duration);
    out.write(1);
    worked += work(duration);
  }
  void take() { worked += work(duration); }
  void take_call() { worked += work(duration); }
};

class Caller : public Component {
 public:
  using Component::Component;
  OperationCaller<void()> call{this, "work", "of the other"};

 private:
  void on_update() override { static_cast<void>(call()); }
};

class Measurement : public testing::Test {
 protected:
  Measurement() : thread_(first_, second_) {
    face(first_.out).connect(face(second_.in), {});
    start(first_, second_);
  }
  void begin_cycle(bool measured) {
    thread_.cycle();
    thread_.context.measuring = measured;
    thread_.context.mark = rt::ticks();
  }
  void end_cycle() {
    thread_.context.measuring = false;
    Host::close_measurements(thread_.context);
  }
  Worker first_{"first"};
  Worker second_{"second"};
  TestThread thread_;
};

TEST_F(Measurement, EachComponentsTimeIsItsOwnWithoutWhatItTriggered) {
  second_.duration = kLong;
  begin_cycle(true);
  const std::uint64_t begin = thread_.context.mark;
  Host::update(first_);
  end_cycle();
  const std::uint64_t whole = rt::ticks() - begin;
  const rt::DistributionSummary first = Host::execution_ticks(first_).summary();
  const rt::DistributionSummary second = Host::execution_ticks(second_).summary();
  ASSERT_EQ(first.count, 1u);
  ASSERT_EQ(second.count, 1u);
  EXPECT_GE(second_.worked, kLong);
  EXPECT_GE(second.total, second_.worked);
  EXPECT_LE(first.total + second.total, whole) << "no time counts twice";
}

TEST_F(Measurement, WhatComesBeforeAndAfterACallBelongsToTheCaller) {
  first_.duration = kLong;
  begin_cycle(true);
  const std::uint64_t begin = thread_.context.mark;
  Host::update(first_);
  end_cycle();
  const std::uint64_t whole = rt::ticks() - begin;
  const std::uint64_t first = Host::execution_ticks(first_).summary().total;
  const std::uint64_t second = Host::execution_ticks(second_).summary().total;
  EXPECT_GE(first, first_.worked);
  EXPECT_GE(first_.worked, 2 * kLong);
  EXPECT_LE(first + second, whole) << "no time counts twice";
}

TEST_F(Measurement, SeveralRunsInACycleAreOneMeasurement) {
  begin_cycle(true);
  Host::update(first_);
  Host::update(first_);
  end_cycle();
  EXPECT_EQ(Host::execution_ticks(first_).summary().count, 1u);
  EXPECT_EQ(Host::execution_ticks(second_).summary().count, 1u);
}

TEST_F(Measurement, NothingIsTakenInOtherCyclesNorOfWhatDidNotRun) {
  begin_cycle(false);
  Host::update(first_);
  end_cycle();
  EXPECT_EQ(Host::execution_ticks(first_).summary().count, 0u);
  begin_cycle(true);
  end_cycle();
  EXPECT_EQ(Host::execution_ticks(first_).summary().count, 0u);
}

TEST_F(Measurement, AGuestFromAnotherThreadIsNotMeasuredThere) {
  Caller caller("caller");
  TestThread other(caller);
  face(caller.call).connect(face(first_.work_here));
  start(caller);
  other.context.measuring = true;
  other.context.mark = rt::ticks();
  Host::update(caller);
  Host::close_measurements(other.context);
  EXPECT_EQ(Host::execution_ticks(caller).summary().count, 1u);
  EXPECT_EQ(Host::execution_ticks(first_).summary().count, 0u);
}

TEST_F(Measurement, AnExceptionDoesNotLoseTheTime) {
  begin_cycle(true);
  Host::run(first_, thread_.context, [] {
    work(kLong);
    throw 1;
  });
  end_cycle();
  EXPECT_GE(Host::execution_ticks(first_).summary().total, kLong);
  EXPECT_EQ(thread_.context.running(), nullptr);
}

}  // namespace
}  // namespace armature::component
