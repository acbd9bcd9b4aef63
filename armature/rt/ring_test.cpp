// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/ring.hpp"

#include <deque>
#include <random>

#include <gtest/gtest.h>

namespace armature::rt {
namespace {

template <typename Atomics>
class RingTest : public ::testing::Test {};
using BothAtomics = ::testing::Types<StdAtomics, PlainAtomics>;
TYPED_TEST_SUITE(RingTest, BothAtomics);

TYPED_TEST(RingTest, IsEmptyAtFirst) {
  Ring<int, TypeParam> ring(3, WhenFull::kDropNewest, 0);
  EXPECT_EQ(ring.capacity(), 3u);
  EXPECT_EQ(ring.pop(), nullptr);
}

TYPED_TEST(RingTest, HoldsExactlyItsCapacityAndRefusesMore) {
  Ring<int, TypeParam> ring(2, WhenFull::kDropNewest, 0);
  EXPECT_EQ(ring.push(1), PushResult::kTaken);
  EXPECT_EQ(ring.push(2), PushResult::kTaken);
  EXPECT_EQ(ring.push(3), PushResult::kRefused);
  EXPECT_EQ(*ring.pop(), 1);
  EXPECT_EQ(ring.push(4), PushResult::kTaken);
  EXPECT_EQ(*ring.pop(), 2);
  EXPECT_EQ(*ring.pop(), 4);
  EXPECT_EQ(ring.pop(), nullptr);
}

TYPED_TEST(RingTest, DropsTheOldestAndSaysSo) {
  Ring<int, TypeParam> ring(2, WhenFull::kDropOldest, 0);
  EXPECT_EQ(ring.push(1), PushResult::kTaken);
  EXPECT_EQ(ring.push(2), PushResult::kTaken);
  EXPECT_EQ(ring.push(3), PushResult::kDroppedOldest);
  EXPECT_EQ(*ring.pop(), 2);
  EXPECT_EQ(*ring.pop(), 3);
  EXPECT_EQ(ring.pop(), nullptr);
}

TYPED_TEST(RingTest, APoppedValueStaysUntilTheNextPop) {
  Ring<int, TypeParam> ring(1, WhenFull::kDropOldest, 0);
  ring.push(1);
  const int* const value = ring.pop();
  for (int i = 2; i < 10; ++i) ring.push(i);
  EXPECT_EQ(*value, 1);
  EXPECT_EQ(*ring.pop(), 9);
}

/// Any sequence of pushes and pops gives what a plain queue gives.
template <typename Atomics>
void compare_with_a_queue(std::size_t capacity, WhenFull when_full, unsigned seed) {
  Ring<int, Atomics> ring(capacity, when_full, 0);
  std::deque<int> queue;
  std::mt19937 random(seed);
  for (int i = 0; i < 2000; ++i) {
    if (random() % 3 != 0) {
      const bool full = queue.size() == capacity;
      const PushResult expected = !full                                ? PushResult::kTaken
                                  : when_full == WhenFull::kDropNewest ? PushResult::kRefused
                                                                       : PushResult::kDroppedOldest;
      ASSERT_EQ(ring.push(i), expected);
      if (expected == PushResult::kDroppedOldest) queue.pop_front();
      if (expected != PushResult::kRefused) queue.push_back(i);
    } else if (queue.empty()) {
      ASSERT_EQ(ring.pop(), nullptr);
    } else {
      ASSERT_EQ(*ring.pop(), queue.front());
      queue.pop_front();
    }
  }
}

TYPED_TEST(RingTest, BehavesAsAQueueOfThatCapacity) {
  for (std::size_t capacity = 1; capacity <= 5; ++capacity) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      compare_with_a_queue<TypeParam>(capacity, WhenFull::kDropNewest, seed);
      compare_with_a_queue<TypeParam>(capacity, WhenFull::kDropOldest, seed);
    }
  }
}

}  // namespace
}  // namespace armature::rt
