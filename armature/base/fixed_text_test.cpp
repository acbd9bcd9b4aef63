// SPDX-License-Identifier: Apache-2.0
#include "armature/base/fixed_text.hpp"

#include <string>
#include <type_traits>

#include <gtest/gtest.h>

namespace armature::base {
namespace {

TEST(FixedText, IsEmptyAtFirst) {
  EXPECT_TRUE(FixedText<4>().empty());
  EXPECT_EQ(FixedText<4>().view(), "");
}

TEST(FixedText, HoldsTextUpToItsCapacity) { EXPECT_EQ(FixedText<4>("abcd").view(), "abcd"); }

TEST(FixedText, CutsLongerTextAtTheEnd) {
  FixedText<4> text("abcdef");
  EXPECT_EQ(text.view(), "abcd");
  text.assign("xyzxyz");
  EXPECT_EQ(text.view(), "xyzx");
}

TEST(FixedText, AppendsWhatFits) {
  FixedText<6> text("ab");
  text.append("cd").append("efgh");
  EXPECT_EQ(text.view(), "abcdef");
}

TEST(FixedText, IsEmptyAfterClear) {
  FixedText<4> text("ab");
  text.clear();
  EXPECT_TRUE(text.empty());
}

TEST(FixedText, ComparesItsTextOnlyAndNotWhatWasThereBefore) {
  FixedText<4> text("abcd");
  text.assign("ab");
  EXPECT_EQ(text, FixedText<4>("ab"));
  EXPECT_FALSE(text == FixedText<4>("ac"));
}

TEST(FixedText, KeepsZeroBytes) {
  const std::string with_zero("a\0b", 3);
  EXPECT_EQ(FixedText<4>(std::string_view(with_zero)).view(), with_zero);
}

TEST(FixedText, CanBeCopiedAsBytes) { EXPECT_TRUE(std::is_trivially_copyable_v<FixedText<16>>); }

}  // namespace
}  // namespace armature::base
