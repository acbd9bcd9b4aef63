// SPDX-License-Identifier: Apache-2.0
#include "armature/base/alternatives.hpp"

#include <gtest/gtest.h>

namespace armature::base {
namespace {

TEST(Alternatives, AreJoinedAsInASentence) {
  EXPECT_EQ(alternatives({}), "");
  EXPECT_EQ(alternatives({"skip"}), "skip");
  EXPECT_EQ(alternatives({"skip", "fault"}), "skip or fault");
  EXPECT_EQ(alternatives({"skip", "catch_up", "fault"}), "skip, catch_up or fault");
  EXPECT_EQ(alternatives({"a", "b", "a"}), "a, b or a") << "by place, not by name";
}

}  // namespace
}  // namespace armature::base
