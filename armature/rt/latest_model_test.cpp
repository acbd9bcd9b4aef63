// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/latest.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;
using Value = model::Data<int>;

/// Three writes beside three fetches: each value whole, none older than the one before.
template <typename Atomics>
model::Result check_order() {
  return model::explore([](model::Program& program) {
    Latest<Value, Atomics> latest(0);
    int seen = 0;
    program.thread("writer", [&] {
      for (int value = 1; value <= 3; ++value) latest.write(value);
    });
    program.thread("reader", [&] {
      for (int i = 0; i < 3; ++i) {
        const bool moved = latest.fetch();
        const int value = latest.value();
        program.expect(moved ? value > seen : value == seen, "the reader went back or stood still");
        seen = value;
      }
    });
    program.join();
    program.expect(latest.fetch() == (seen != 3), "fetch is wrong about what is new");
    program.expect(latest.value() == 3, "the last value is lost");
  });
}

/// A write that finished before the fetch began is seen by it.
template <typename Atomics>
model::Result check_finished_write() {
  return model::explore([](model::Program& program) {
    Latest<Value, Atomics> latest(0);
    model::Atomic<int> finished(0);
    program.thread("writer", [&] {
      for (int value = 1; value <= 2; ++value) {
        latest.write(value);
        finished.store(value, model::Order::release);
      }
    });
    program.thread("reader", [&] {
      latest.fetch();
      const int least = finished.load(model::Order::acquire);
      latest.fetch();
      program.expect(latest.value() >= least, "a finished write was not seen");
    });
    program.join();
  });
}

TEST(LatestModel, ValuesAreWholeAndNeverGoBack) {
  const model::Result result = check_order<model::Atomics>();
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.executions, 50u);
  RecordProperty("executions", static_cast<int>(result.executions));
}

TEST(LatestModel, AFinishedWriteIsSeen) {
  EXPECT_EQ(check_finished_write<model::Atomics>().failure, "");
}

TEST(LatestModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_order<model::AtomicsWithoutRelease>().failure, HasSubstr("data race"));
  EXPECT_THAT(check_order<model::AtomicsWithoutAcquire>().failure, HasSubstr("data race"));
}

TEST(LatestModel, TheCheckFindsASwapInTwoSteps) {
  EXPECT_FALSE(check_order<model::AtomicsInTwoSteps>().ok());
}

/// Two slots instead of three: the writer has nowhere to go while the reader reads.
template <typename T, typename Atomics>
class TwoSlots {
 public:
  explicit TwoSlots(T initial) : slots_{initial, initial} {}
  void write(const T& value) {
    const int back = 1 - front_.load(model::Order::relaxed);
    slots_[static_cast<std::size_t>(back)] = value;
    front_.store(back, model::Order::release);
  }
  int read() const { return slots_[static_cast<std::size_t>(front_.load(model::Order::acquire))]; }

 private:
  std::array<T, 2> slots_;
  typename Atomics::template Atomic<int> front_{0};
};

TEST(LatestModel, TheCheckFindsThatTwoSlotsAreTooFew) {
  const model::Result result = model::explore([](model::Program& program) {
    TwoSlots<Value, model::Atomics> latest(0);
    program.thread("writer", [&] {
      latest.write(1);
      latest.write(2);
    });
    program.thread("reader", [&] { program.expect(latest.read() <= 2, "torn"); });
    program.join();
  });
  EXPECT_THAT(result.failure, HasSubstr("data race"));
}

}  // namespace
}  // namespace armature::rt
