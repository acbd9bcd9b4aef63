// SPDX-License-Identifier: Apache-2.0
#include "armature/base/utf8.hpp"

#include <string>

#include <gtest/gtest.h>

namespace armature::base {
namespace {

// A lone continuation, overlong forms, a surrogate, beyond the last character, cut off.
constexpr const char* kBroken[] = {
    "\x80",         "\xc1\xbf",         "\xe0\x9f\xbf",     "\xf0\x8f\xbf\xbf",
    "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xe2\x82",
    "\xe2\x82z"};

TEST(Utf8, IsWhatTheUnicodeStandardSays) {
  for (const char* text : {"", "a", "µ", "€", "\xf0\x9f\xa4\x96", "\xed\x9f\xbf"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
  }
  for (const char* text : kBroken) EXPECT_FALSE(is_utf8(text)) << text;
}

TEST(Utf8, TheFirstBrokenByteIsFoundWhereverItLies) {
  for (const char* broken : kBroken) {
    for (std::size_t before = 0; before < 20; ++before) {
      const std::string text = std::string(before, 'a') + broken + std::string(20, 'z');
      EXPECT_EQ(valid_utf8_length(text), before) << text;
    }
  }
  EXPECT_EQ(valid_utf8_length("eight by\xc3\xbc"
                              "eight by"),
            18u);
}

TEST(Utf8, CharactersAreCountedWithoutTheirContinuations) {
  EXPECT_EQ(character_count(""), 0u);
  EXPECT_EQ(character_count("Grüße, 関節"), 9u);
}

}  // namespace
}  // namespace armature::base
