// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/index_switch.hpp"

#include <gtest/gtest.h>

namespace armature::sim {
namespace {

TEST(IndexSwitch, IsClosedNearItsPositionOnly) {
  constexpr IndexSwitch kIndex{.centre = 0.5, .half_width = 0.01};
  EXPECT_TRUE(kIndex.closed(0.5));
  EXPECT_TRUE(kIndex.closed(0.4901));
  EXPECT_TRUE(kIndex.closed(0.5099));
  EXPECT_FALSE(kIndex.closed(0.4899));
  EXPECT_FALSE(kIndex.closed(0.5101));
}

}  // namespace
}  // namespace armature::sim
