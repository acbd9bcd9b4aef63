// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/ring.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;
using Value = model::Data<int>;

template <typename Atomics>
using ProductionRing = Ring<Value, Atomics>;

struct Case {
  std::size_t capacity;
  WhenFull when_full;
  int pushes;
  int pops;
};

/// What the two threads saw, each in its own part.
struct Record {
  std::vector<int> refused;
  int dropped = 0;
  std::vector<int> received;
};

template <typename AnyRing>
void push_values(AnyRing& ring, int count, Record& record) {
  for (int value = 1; value <= count; ++value) {
    const PushResult result = ring.push(value);
    if (result == PushResult::kRefused) record.refused.push_back(value);
    if (result == PushResult::kDroppedOldest) ++record.dropped;
  }
}

template <typename AnyRing>
bool pop_value(AnyRing& ring, Record& record) {
  const Value* value = ring.pop();
  if (value != nullptr) record.received.push_back(*value);
  return value != nullptr;
}

void expect_all_accounted_for(model::Program& program, const Case& values, const Record& record) {
  const std::vector<int>& received = record.received;
  program.expect(std::is_sorted(received.begin(), received.end()),
                 "not in the order of the pushes");
  program.expect(std::adjacent_find(received.begin(), received.end()) == received.end(),
                 "a value came twice");
  for (const int value : record.refused) {
    program.expect(std::find(received.begin(), received.end(), value) == received.end(),
                   "a refused value was received");
  }
  const auto missing = static_cast<std::size_t>(values.pushes) - received.size();
  program.expect(missing == record.refused.size() + static_cast<std::size_t>(record.dropped),
                 std::to_string(missing) + " values are missing, the writer was told of " +
                     std::to_string(record.refused.size()) + " refused and " +
                     std::to_string(record.dropped) + " dropped");
}

template <typename AnyRing>
model::Result check_ring(const Case& values) {
  return model::explore([=](model::Program& program) {
    AnyRing ring(values.capacity, values.when_full, 0);
    Record record;
    program.thread("writer", [&] { push_values(ring, values.pushes, record); });
    program.thread("reader", [&] {
      for (int i = 0; i < values.pops; ++i) pop_value(ring, record);
    });
    program.join();
    while (pop_value(ring, record)) {
    }
    expect_all_accounted_for(program, values, record);
  });
}

class RingModel : public ::testing::TestWithParam<Case> {};

TEST_P(RingModel, ValuesComeOnceInOrderAndTheMissingAreAccountedFor) {
  const model::Result result = check_ring<ProductionRing<model::Atomics>>(GetParam());
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.executions, 10u);
  RecordProperty("executions", static_cast<int>(result.executions));
}

TEST_P(RingModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_ring<ProductionRing<model::AtomicsWithoutRelease>>(GetParam()).failure,
              HasSubstr("data race"));
  EXPECT_THAT(check_ring<ProductionRing<model::AtomicsWithoutAcquire>>(GetParam()).failure,
              HasSubstr("data race"));
}

INSTANTIATE_TEST_SUITE_P(
    AllPolicies, RingModel,
    ::testing::Values(Case{1, WhenFull::kDropNewest, 4, 3}, Case{2, WhenFull::kDropNewest, 5, 3},
                      Case{3, WhenFull::kDropNewest, 6, 3}, Case{1, WhenFull::kDropOldest, 4, 3},
                      Case{2, WhenFull::kDropOldest, 5, 3}, Case{3, WhenFull::kDropOldest, 7, 3}),
    [](const auto& tested) {
      return std::string(tested.param.when_full == WhenFull::kDropNewest ? "Refuse"
                                                                         : "DropOldest") +
             std::to_string(tested.param.capacity);
    });

TEST(RingModelDropOldest, TheCheckFindsASwapInTwoSteps) {
  EXPECT_FALSE(
      check_ring<ProductionRing<model::AtomicsInTwoSteps>>({2, WhenFull::kDropOldest, 4, 2}).ok());
}

template <typename Atomics>
model::Result check_finished_push(WhenFull when_full) {
  return model::explore([=](model::Program& program) {
    ProductionRing<Atomics> ring(2, when_full, 0);
    model::Atomic<int> finished(0);
    program.thread("writer", [&] {
      for (int value = 1; value <= 3; ++value) {
        ring.push(value);
        finished.store(value, model::Order::release);
      }
    });
    program.thread("reader", [&] {
      int last = 0;
      const int least = finished.load(model::Order::acquire);
      while (const Value* value = ring.pop()) last = *value;
      program.expect(last >= std::min(least, 2), "a finished push was not seen");
    });
    program.join();
  });
}

TEST(RingModelBothPolicies, AFinishedPushIsSeen) {
  EXPECT_EQ(check_finished_push<model::Atomics>(WhenFull::kDropNewest).failure, "");
  EXPECT_EQ(check_finished_push<model::Atomics>(WhenFull::kDropOldest).failure, "");
}

TEST(RingModelRefuse, OnlyAFullRingRefuses) {
  const model::Result result = model::explore([](model::Program& program) {
    ProductionRing<model::Atomics> ring(2, WhenFull::kDropNewest, 0);
    model::Atomic<int> popped(0);
    program.thread("writer", [&] {
      ring.push(1);
      ring.push(2);
      const bool has_room = popped.load(model::Order::acquire) == 1;
      const bool refused = ring.push(3) == PushResult::kRefused;
      program.expect(!(has_room && refused), "refused although there is room");
    });
    program.thread("reader", [&] {
      if (ring.pop() != nullptr) popped.store(1, model::Order::release);
    });
    program.join();
  });
  EXPECT_EQ(result.failure, "");
}

/// Ring's drop-oldest without turns: a reader that the writer has lapped does not notice.
class RingWithoutTurns {
 public:
  RingWithoutTurns(std::size_t capacity, WhenFull, const Value& sample)
      : slots_(capacity + 2, sample), entries_(capacity), mine_(capacity), readers_(capacity + 1) {
    for (std::size_t i = 0; i < capacity; ++i) entries_[i].store(i << 1, model::Order::relaxed);
  }
  PushResult push(const Value& value) {
    slots_[mine_] = value;
    const std::size_t old = entries_[write_index_].exchange(mine_ << 1 | 1, model::Order::acq_rel);
    mine_ = old >> 1;
    write_index_ = (write_index_ + 1) % entries_.size();
    return (old & 1) != 0 ? PushResult::kDroppedOldest : PushResult::kTaken;
  }
  const Value* pop() {
    auto& entry = entries_[read_index_];
    if ((entry.load(model::Order::acquire) & 1) == 0) return nullptr;
    readers_ = entry.exchange(readers_ << 1, model::Order::acq_rel) >> 1;
    read_index_ = (read_index_ + 1) % entries_.size();
    return &slots_[readers_];
  }

 private:
  std::vector<Value> slots_;
  std::vector<model::Atomic<std::size_t>> entries_;
  std::size_t mine_, readers_;
  std::size_t write_index_ = 0, read_index_ = 0;
};

TEST(RingModelDropOldest, TheCheckFindsMissingTurns) {
  EXPECT_THAT(check_ring<RingWithoutTurns>({2, WhenFull::kDropOldest, 4, 1}).failure,
              HasSubstr("not in the order of the pushes"));
}

}  // namespace
}  // namespace armature::rt
