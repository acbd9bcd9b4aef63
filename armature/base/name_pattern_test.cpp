// SPDX-License-Identifier: Apache-2.0
#include "armature/base/name_pattern.hpp"

#include <gtest/gtest.h>

namespace armature::base {
namespace {

TEST(Matching, IsOfTheWholeName) {
  EXPECT_TRUE(matches("a*b", "ab"));
  EXPECT_TRUE(matches("a*b", "axxb"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("**x", "abx"));
  EXPECT_FALSE(matches("a*b", "a.b"));
  EXPECT_FALSE(matches("a", "ab"));
  EXPECT_FALSE(matches("ab", "a"));
  EXPECT_FALSE(matches("", "a"));
}

}  // namespace
}  // namespace armature::base
