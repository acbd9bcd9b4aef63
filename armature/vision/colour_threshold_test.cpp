// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/colour_threshold.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/vision/hsv.hpp"

namespace armature::vision {
namespace {

using ::testing::HasSubstr;

ColourThreshold threshold_of(const ColourThreshold::Config& config) {
  return ColourThreshold::make(config).value();
}

TEST(ColourThreshold, TakesItsColourInEachShade) {
  const ColourThreshold red = threshold_of({.wanted = {255, 0, 0}});
  EXPECT_TRUE(red.holds({255, 0, 0}));
  EXPECT_TRUE(red.holds({60, 12, 10}));
  EXPECT_FALSE(red.holds({0, 0, 255}));
  EXPECT_FALSE(red.holds({255, 128, 0})) << "orange";
}

TEST(ColourThreshold, LeavesOutGreyAndBlack) {
  const ColourThreshold red = threshold_of({.min_saturation = 0.4, .min_value = 0.2});
  EXPECT_TRUE(red.holds({100, 60, 60}));
  EXPECT_FALSE(red.holds({100, 61, 61})) << "saturation below 0.4";
  EXPECT_TRUE(red.holds({51, 0, 0}));
  EXPECT_FALSE(red.holds({50, 0, 0})) << "value below 0.2";
  EXPECT_FALSE(red.holds({0, 0, 0}));
}

/// What it computes without a division is what it promises, around the whole circle.
TEST(ColourThreshold, AgreesWithTheHueSaturationAndValueOfEachPixel) {
  int held = 0;
  for (const Rgb wanted : {Rgb{255, 0, 0}, Rgb{250, 10, 40}, Rgb{20, 200, 30}, Rgb{10, 30, 220},
                           Rgb{0, 200, 200}, Rgb{240, 0, 239}, Rgb{120, 121, 0}}) {
    for (const double tolerance : {0.1234, 0.3456, 1.0}) {
      const ColourThreshold::Config config{wanted, tolerance, 0.31, 0.17};
      const ColourThreshold threshold = threshold_of(config);
      const double hue = hsv_of(wanted).hue_rad;
      for (int i = 0; i < 256 * 256 * 256; i += 419) {
        const Rgb pixel{static_cast<std::uint8_t>(i >> 16), static_cast<std::uint8_t>(i >> 8),
                        static_cast<std::uint8_t>(i)};
        const Hsv colour = hsv_of(pixel);
        const bool expected = colour.saturation >= config.min_saturation &&
                              colour.value >= config.min_value &&
                              hue_distance(colour.hue_rad, hue) <= tolerance;
        ASSERT_EQ(threshold.holds(pixel), expected)
            << int(pixel.red) << " " << int(pixel.green) << " " << int(pixel.blue);
        held += expected ? 1 : 0;
      }
    }
  }
  EXPECT_GT(held, 10000);
}

TEST(ColourThreshold, MasksAnImagePixelByPixel) {
  Image image({2, 2});
  image.set(1, 0, {255, 0, 0});
  image.set(0, 1, {255, 0, 10});
  std::vector<std::uint8_t> mask(4, 9);
  threshold_of({}).mask(image.view(), mask);
  EXPECT_THAT(mask, ::testing::ElementsAre(0, 1, 1, 0));
}

TEST(ColourThreshold, DistanceIsThatOfTheHues) {
  const ColourThreshold red = threshold_of({});
  EXPECT_EQ(red.distance({200, 0, 0}), 0.0);
  EXPECT_DOUBLE_EQ(red.distance({0, 200, 200}), 1.0);
  EXPECT_NEAR(red.distance({200, 200, 0}), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(red.distance({120, 120, 120}), 1.0) << "a grey has no hue";
}

TEST(ColourThreshold, MistakesNameTheirFields) {
  const auto wrong = ColourThreshold::make({.wanted = {90, 90, 90},
                                            .hue_tolerance_rad = 1.2,
                                            .min_saturation = 0.0,
                                            .min_value = std::nan("")});
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error(),
              HasSubstr("wanted.saturation is 0, expected above 0: a grey has no hue"));
  EXPECT_THAT(wrong.error(),
              HasSubstr("hue_tolerance_rad is 1.2, expected above 0, at most pi / 3"));
  EXPECT_THAT(wrong.error(), HasSubstr("min_saturation is 0, expected above 0, at most 1"));
  EXPECT_THAT(wrong.error(), HasSubstr("min_value is nan"));
}

}  // namespace
}  // namespace armature::vision
