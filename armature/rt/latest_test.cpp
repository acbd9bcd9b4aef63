// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/latest.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace armature::rt {
namespace {

template <typename Atomics>
class LatestTest : public ::testing::Test {};
using BothAtomics = ::testing::Types<StdAtomics, PlainAtomics>;
TYPED_TEST_SUITE(LatestTest, BothAtomics);

TYPED_TEST(LatestTest, ShowsTheInitialValueUntilTheFirstWrite) {
  Latest<int, TypeParam> latest(7);
  EXPECT_FALSE(latest.fetch());
  EXPECT_EQ(latest.value(), 7);
}

TYPED_TEST(LatestTest, TheReaderSeesTheNewestValueOnce) {
  Latest<int, TypeParam> latest(0);
  for (int value = 1; value <= 5; ++value) latest.write(value);
  EXPECT_EQ(latest.value(), 0);
  EXPECT_TRUE(latest.fetch());
  EXPECT_EQ(latest.value(), 5);
  EXPECT_FALSE(latest.fetch());
  EXPECT_EQ(latest.value(), 5);
}

TYPED_TEST(LatestTest, AWriteLeavesTheReadersValueAlone) {
  Latest<int, TypeParam> latest(0);
  latest.write(1);
  latest.fetch();
  const int& seen = latest.value();
  latest.write(2);
  latest.write(3);
  EXPECT_EQ(seen, 1);
}

TYPED_TEST(LatestTest, AVectorOfTheInitialSizeStaysWhereItIs) {
  Latest<std::vector<double>, TypeParam> latest(std::vector<double>(3, 0.0));
  for (int i = 1; i <= 4; ++i) {
    latest.write(std::vector<double>(3, i));
    latest.fetch();
    EXPECT_EQ(latest.value(), std::vector<double>(3, i));
    EXPECT_EQ(latest.value().capacity(), 3u);
  }
}

}  // namespace
}  // namespace armature::rt
