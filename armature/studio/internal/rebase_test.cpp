// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/rebase.hpp"

#include <string>

#include <gtest/gtest.h>

namespace armature::studio::internal {
namespace {

/// What two make of a text that did not know of each other; `?` where they changed the same.
std::string both(const std::string& text, const std::string& mine, const std::string& theirs) {
  const auto moved = rebased(difference(text, mine), difference(text, theirs));
  return moved ? edit::replaced(theirs, *moved) : "?";
}

TEST(Difference, IsOneReplacementOfWhatDiffers) {
  EXPECT_EQ(difference("one two", "one two"), Replacements{});
  EXPECT_EQ(difference("one two", "one three two"), (Replacements{{5, 5, "hree t"}}));
  EXPECT_EQ(difference("aaa", "aa"), (Replacements{{2, 3, ""}}));
  EXPECT_EQ(difference("", "all"), (Replacements{{0, 0, "all"}}));
  EXPECT_EQ(edit::replaced("one two", difference("one two", "one too")), "one too");
}

TEST(Difference, NoCharacterIsDivided) {
  EXPECT_EQ(difference("a\u00e4b", "a\u00f6b"), (Replacements{{1, 3, "\u00f6"}}));
  EXPECT_EQ(difference("\u00e4", "\u0164"), (Replacements{{0, 2, "\u0164"}}));
}

TEST(Rebased, BothChangesAreInTheText) {
  EXPECT_EQ(both("a: 1\nb: 2\n", "a: 10\nb: 2\n", "a: 1\nb: 20\n"), "a: 10\nb: 20\n");
  EXPECT_EQ(both("a: 1\nb: 2\n", "a: 1\nb: 20\n", "aa: 10\nb: 2\n"), "aa: 10\nb: 20\n");
  EXPECT_EQ(both("a\nb\nc\n", "a\nb\n", "b\nc\n"), "b\n");
}

TEST(Rebased, WhatBothChangedIsRefused) {
  EXPECT_EQ(both("a: 1\n", "a: 2\n", "a: 3\n"), "?");
  EXPECT_EQ(both("a\n", "a\nb\n", "a\nc\n"), "?");
  EXPECT_EQ(both("abc", "", "abxc"), "?");
}

TEST(Rebased, OnWhatNobodyElseChangedItStays) {
  const Replacements mine = difference("abc", "axc");
  EXPECT_EQ(rebased(mine, {}), mine);
  EXPECT_EQ(rebased({}, difference("abc", "xyz")), Replacements{});
}

}  // namespace
}  // namespace armature::studio::internal
