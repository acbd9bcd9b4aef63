// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/quick_latest.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;

struct Value {
  std::uint64_t sequence = 0;
};

/// Three writes beside three fetches: none older than the one before, and the last is not lost.
template <template <typename, typename> class Kind, typename Atomics>
model::Result check_order() {
  return model::explore([](model::Program& program) {
    Kind<Value, Atomics> latest(Value{});
    std::uint64_t seen = 0;
    const auto look = [&] {
      const Value* const found = latest.fetch();
      if (found == nullptr) return;
      program.expect(found->sequence > seen, "the reader went back");
      seen = found->sequence;
    };
    program.thread("writer", [&] {
      for (std::uint64_t sequence = 1; sequence <= 3; ++sequence) latest.write({sequence});
    });
    program.thread("reader", [&] {
      for (int i = 0; i < 3; ++i) look();
    });
    program.join();
    look();
    program.expect(seen == 3, "the last value is lost");
  });
}

/// A write that finished before the fetch began is seen by it.
template <typename Atomics>
model::Result check_finished_write() {
  return model::explore([](model::Program& program) {
    QuickLatest<Value, Atomics> latest(Value{});
    model::Atomic<std::uint64_t> finished(0);
    program.thread("writer", [&] {
      for (std::uint64_t sequence = 1; sequence <= 3; ++sequence) {
        latest.write({sequence});
        finished.store(sequence, model::Order::release);
      }
    });
    program.thread("reader", [&] {
      std::uint64_t seen = 0;
      for (int i = 0; i < 2; ++i) {
        const std::uint64_t least = finished.load(model::Order::acquire);
        if (const Value* const found = latest.fetch()) seen = found->sequence;
        program.expect(seen >= least, "a finished write was not seen");
      }
    });
    program.join();
  });
}

TEST(QuickLatestModel, ValuesNeverGoBackAndTheLastIsNotLost) {
  const model::Result result = check_order<QuickLatest, model::Atomics>();
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.executions, 50u);
  RecordProperty("executions", static_cast<int>(result.executions));
}

TEST(QuickLatestModel, AFinishedWriteIsSeen) {
  EXPECT_EQ(check_finished_write<model::Atomics>().failure, "");
}

TEST(QuickLatestModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT((check_order<QuickLatest, model::AtomicsWithoutRelease>().failure),
              HasSubstr("data race"));
  EXPECT_THAT((check_order<QuickLatest, model::AtomicsWithoutAcquire>().failure),
              HasSubstr("data race"));
}

/// Takes what it finds last, in the slot or in the cell, for the newest.
template <typename T, typename Atomics>
class WithoutNumbers {
 public:
  explicit WithoutNumbers(const T& initial) : cell_(initial), slot_(initial) {}
  void write(const T& value) {
    if (full_.load(std::memory_order_acquire)) {
      cell_.write(value);
    } else {
      slot_ = value;
      full_.store(true, std::memory_order_release);
    }
  }
  const T* fetch() {
    const T* found = nullptr;
    if (full_.load(std::memory_order_acquire)) {
      received_ = slot_;
      full_.store(false, std::memory_order_release);
      found = &received_;
    }
    return cell_.fetch() ? &cell_.value() : found;
  }

 private:
  T received_{};
  Latest<T, Atomics> cell_;
  typename Atomics::template Atomic<bool> full_{false};
  typename Atomics::template Plain<T> slot_;
};

TEST(QuickLatestModel, TheCheckFindsThatTheNumbersAreNeeded) {
  EXPECT_THAT((check_order<WithoutNumbers, model::Atomics>().failure),
              HasSubstr("the reader went back"));
}

}  // namespace
}  // namespace armature::rt
