// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/quick_latest.hpp"

#include <gtest/gtest.h>

namespace armature::rt {
namespace {

struct Value {
  int number = 0;
  std::uint64_t sequence = 0;
};

TEST(QuickLatest, GivesNothingBeforeTheFirstWrite) {
  QuickLatest<Value> latest(Value{});
  EXPECT_EQ(latest.fetch(), nullptr);
}

TEST(QuickLatest, GivesEachValueOnce) {
  QuickLatest<Value> latest(Value{});
  for (std::uint64_t i = 1; i <= 5; ++i) {
    latest.write({static_cast<int>(10 * i), i});
    const Value* const found = latest.fetch();
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->number, static_cast<int>(10 * i));
    EXPECT_EQ(latest.fetch(), nullptr);
  }
}

TEST(QuickLatest, GivesTheNewestOfSeveral) {
  QuickLatest<Value> latest(Value{});
  for (std::uint64_t i = 1; i <= 5; ++i) latest.write({static_cast<int>(i), i});
  const Value* found = latest.fetch();
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->number, 5);
  latest.write({6, 6});
  found = latest.fetch();
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->number, 6);
}

TEST(QuickLatest, AWriteLeavesTheReadersValueAlone) {
  QuickLatest<Value> latest(Value{});
  for (const std::uint64_t before : {1u, 4u}) {  // by the slot, and by the cell
    for (std::uint64_t i = before; i < before + 2; ++i) latest.write({static_cast<int>(i), i});
    const Value* const found = latest.fetch();
    ASSERT_NE(found, nullptr);
    const int seen = found->number;
    latest.write({100, before + 2});
    EXPECT_EQ(found->number, seen);
    latest.fetch();
  }
}

}  // namespace
}  // namespace armature::rt
