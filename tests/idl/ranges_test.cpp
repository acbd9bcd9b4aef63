// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "armature/ride/flags.hpp"
#include "everything_types.hpp"
#include "tests/idl/bytes.hpp"

namespace armature::idl {
namespace {

using everything::Ranges;

Ranges good() {
  Ranges value;
  value.o = 1;
  value.ui = 3;
  value.l = -1;
  value.ul = 1ull << 63;
  value.d = 0.5;
  return value;
}

bool is_taken(const Ranges& value) {
  Ranges taken;
  return transfer(value, taken);
}

TEST(Ranges, ValuesAtBothEndsAreTaken) {
  EXPECT_TRUE(is_taken(good()));
  Ranges other{127,        5,     255,
               0,          65535, 7,
               4294967295, -1,    std::numeric_limits<std::uint64_t>::max(),
               1e3f,       2.0,   {0, 9},
               {9, 0},     {{1}}};
  EXPECT_TRUE(is_taken(other));
  other.l = std::numeric_limits<std::int64_t>::min();
  other.s = -32768;
  other.i = std::numeric_limits<std::int32_t>::min();
  other.f = -0.1f;
  EXPECT_TRUE(is_taken(other));
}

/// The values of `good`, but for one.
template <typename T, typename Value>
bool is_taken_with(T Ranges::*member, Value value) {
  Ranges changed = good();
  changed.*member = static_cast<T>(value);
  EXPECT_EQ(in_range(changed), is_taken(changed));
  return is_taken(changed);
}

TEST(Ranges, WhatIsOutsideIsRefused) {
  EXPECT_FALSE(is_taken_with(&Ranges::c, 6));
  EXPECT_FALSE(is_taken_with(&Ranges::c, -6));
  EXPECT_FALSE(is_taken_with(&Ranges::o, 0));
  EXPECT_FALSE(is_taken_with(&Ranges::s, 1));
  EXPECT_FALSE(is_taken_with(&Ranges::i, 8));
  EXPECT_FALSE(is_taken_with(&Ranges::ui, 2));
  EXPECT_FALSE(is_taken_with(&Ranges::l, 0));
  EXPECT_FALSE(is_taken_with(&Ranges::ul, (1ull << 63) - 1));
  EXPECT_FALSE(is_taken_with(&Ranges::f, std::nextafter(-0.1f, -1.0f)));
  EXPECT_FALSE(is_taken_with(&Ranges::d, std::nextafter(2.0, 3.0)));
}

TEST(Ranges, NoNumberIsOutside) {
  EXPECT_FALSE(is_taken_with(&Ranges::f, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_FALSE(is_taken_with(&Ranges::d, std::numeric_limits<double>::quiet_NaN()));
}

TEST(Ranges, EachElementOfAnArrayIsLookedAt) {
  EXPECT_TRUE(is_taken_with(&Ranges::list, std::vector<std::int32_t>{0, 9, 3}));
  EXPECT_FALSE(is_taken_with(&Ranges::list, std::vector<std::int32_t>{0, 10, 3}));
  EXPECT_FALSE(is_taken_with(&Ranges::fixed, (std::array<std::int32_t, 2>{0, -1})));
}

TEST(Ranges, MembersOfStructsInArraysAreLookedAt) {
  EXPECT_FALSE(is_taken_with(&Ranges::later, std::vector<everything::Later>{{0}, {2}}));
}

TEST(Ranges, ACharIsANumberFromMinus128) {
  EXPECT_TRUE(ride::within(static_cast<char>(-3), -5, 5));
  EXPECT_FALSE(ride::within(static_cast<char>(-6), -5, 5));
}

TEST(Ranges, TheTextNamesParameterValueAndRange) {
  EXPECT_EQ(ride::outside("a", 300, "0 to 255"), "parameter a is 300, expected 0 to 255");
  EXPECT_EQ(ride::outside("f", 0.1f, "0.25 to 1"), "parameter f is 0.1, expected 0.25 to 1");
  EXPECT_EQ(ride::outside("q", std::vector<int>{7}, "0 to 5"),
            "parameter q has an element outside its range, expected 0 to 5");
}

TEST(Flags, AreSentAsZeroAndOneAndTakenAsNothingElse) {
  EXPECT_EQ(encoded(ride::Flags{0, 1, 7}), "03 00 00 00 00 01 01");
  ride::Flags taken;
  EXPECT_TRUE(transfer(ride::Flags{0, 7}, taken));
  EXPECT_EQ(taken, (ride::Flags{0, 1}));
  EXPECT_FALSE(transfer(std::vector<std::uint8_t>{0, 7}, taken));
}

}  // namespace
}  // namespace armature::idl
