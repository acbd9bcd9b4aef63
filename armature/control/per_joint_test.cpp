// SPDX-License-Identifier: Apache-2.0
#include "armature/control/per_joint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::ElementsAre;

TEST(PerJoint, OneForEachStaysAsItIs) {
  EXPECT_THAT(per_joint("max_vel", {1.0, 2.0}, 2).value(), ElementsAre(1.0, 2.0));
}

TEST(PerJoint, OneIsForAll) {
  EXPECT_THAT(per_joint("max_vel", {1.5}, 3).value(), ElementsAre(1.5, 1.5, 1.5));
}

TEST(PerJoint, AnotherNumberIsRefusedSayingWhatWasExpected) {
  const auto answer = per_joint("max_vel", {1.0, 2.0}, 3);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error(),
            "max_vel: found 2 numbers, expected 3, one for each joint, or one for all");
  EXPECT_FALSE(per_joint("max_vel", {}, 1));
}

}  // namespace
}  // namespace armature::control
