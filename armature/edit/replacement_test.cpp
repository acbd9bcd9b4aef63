// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/replacement.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace armature::edit {
namespace {

using Replacements = std::vector<Replacement>;

TEST(Replacement, ChangesItsRangesAndNothingElse) {
  EXPECT_EQ(replaced("0123456789", {{0, 0, "a"}, {2, 4, ""}, {9, 10, "xyz"}}), "a0145678xyz");
  EXPECT_EQ(replaced("0123", {}), "0123");
}

TEST(Replacement, IsTakenBackByItsInverse) {
  const std::string text = "0123456789";
  const Replacements replacements = {{0, 0, "a"}, {2, 4, ""}, {4, 4, "b"}, {9, 10, "xyz"}};
  EXPECT_EQ(replaced(replaced(text, replacements), inverse_of(text, replacements)), text);
}

TEST(Replacement, OfWhatWasReplacedIsOneOfTheOriginal) {
  EXPECT_EQ(composed(10, {{2, 4, "ab"}}, {{3, 5, "x"}}), (Replacements{{2, 5, "ax"}}));
  EXPECT_EQ(composed(10, {{2, 2, "abc"}}, {{2, 5, ""}}), Replacements{});
  EXPECT_EQ(composed(10, {}, {{0, 10, ""}}), (Replacements{{0, 10, ""}}));
}

/// Up to four replacements of a text of that size, in order.
Replacements random_replacements(std::size_t size, std::mt19937& random) {
  std::vector<std::size_t> places;
  for (int i = 0; i < 8; ++i) places.push_back(random() % (size + 1));
  std::sort(places.begin(), places.end());
  Replacements replacements;
  for (std::size_t i = 0; i + 1 < places.size(); i += 2) {
    const std::string text(random() % 3, static_cast<char>('a' + random() % 26));
    replacements.push_back({places[i], places[i + 1], text});
  }
  return replacements;
}

TEST(Replacement, ComposesToWhatBothGive) {
  std::mt19937 random(7);
  const std::string text = "the quick brown fox jumps over the lazy dog";
  for (int i = 0; i < 2000; ++i) {
    const Replacements first = random_replacements(text.size(), random);
    const std::string between = replaced(text, first);
    const Replacements second = random_replacements(between.size(), random);
    const std::string after = replaced(between, second);
    const Replacements both = composed(text.size(), first, second);
    ASSERT_EQ(replaced(text, both), after);
    ASSERT_EQ(replaced(after, inverse_of(text, both)), text);
  }
}

}  // namespace
}  // namespace armature::edit
