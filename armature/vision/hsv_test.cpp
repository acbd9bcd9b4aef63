// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/hsv.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace armature::vision {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Hsv, PureColoursLieASixthApart) {
  EXPECT_DOUBLE_EQ(hsv_of({255, 0, 0}).hue_rad, 0.0);
  EXPECT_DOUBLE_EQ(hsv_of({255, 255, 0}).hue_rad, kPi / 3.0);
  EXPECT_DOUBLE_EQ(hsv_of({0, 255, 0}).hue_rad, 2.0 * kPi / 3.0);
  EXPECT_DOUBLE_EQ(hsv_of({0, 255, 255}).hue_rad, kPi);
  EXPECT_DOUBLE_EQ(hsv_of({0, 0, 255}).hue_rad, -2.0 * kPi / 3.0);
  EXPECT_DOUBLE_EQ(hsv_of({255, 0, 255}).hue_rad, -kPi / 3.0);
}

TEST(Hsv, GreysHaveNoSaturation) {
  const Hsv grey = hsv_of({51, 51, 51});
  EXPECT_EQ(grey.saturation, 0.0);
  EXPECT_DOUBLE_EQ(grey.value, 0.2);
  EXPECT_EQ(hsv_of({0, 0, 0}).value, 0.0);
}

TEST(Hsv, ShadeChangesTheValueAlone) {
  const Hsv lit = hsv_of({200, 100, 50});
  const Hsv shaded = hsv_of({100, 50, 25});
  EXPECT_DOUBLE_EQ(lit.hue_rad, shaded.hue_rad);
  EXPECT_DOUBLE_EQ(lit.saturation, shaded.saturation);
  EXPECT_DOUBLE_EQ(lit.saturation, 0.75);
  EXPECT_DOUBLE_EQ(lit.value, 2.0 * shaded.value);
}

TEST(Hsv, HueDistanceGoesTheShorterWay) {
  EXPECT_NEAR(hue_distance(-3.0, 3.0), 2.0 * kPi - 6.0, 1e-12);
  EXPECT_DOUBLE_EQ(hue_distance(0.5, -0.25), 0.75);
  EXPECT_DOUBLE_EQ(hue_distance(0.0, kPi), kPi);
}

}  // namespace
}  // namespace armature::vision
