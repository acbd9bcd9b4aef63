// SPDX-License-Identifier: Apache-2.0
// The real-time functions of vision.
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "armature/vision/ball_finder.hpp"
#include "armature/vision/hsv.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::vision {
namespace {

constexpr ImageShape kShape{64, 48};

/// A grey picture with a red square.
std::vector<std::uint8_t> make_picture() {
  std::vector<std::uint8_t> pixels(3u * 64u * 48u, 90);
  for (std::size_t row = 10; row < 22; ++row) {
    for (std::size_t column = 20; column < 32; ++column) {
      pixels[3 * (64 * row + column)] = 230;
      pixels[3 * (64 * row + column) + 1] = 20;
      pixels[3 * (64 * row + column) + 2] = 20;
    }
  }
  return pixels;
}

TEST(RealtimeVision, Colours) {
  double sum = 0.0;
  expect_realtime("vision::hsv_of", [&] { sum += hsv_of({200, 100, 50}).value; });
  expect_realtime("vision::hue_distance", [&] { sum += hue_distance(3.0, -3.0); });
  EXPECT_GT(sum, 0.0);
}

TEST(RealtimeVision, AThresholdAndItsBlobs) {
  auto made = ColourThreshold::make({});
  ASSERT_TRUE(made.ok()) << made.error();
  const ColourThreshold threshold = std::move(made).value();
  const std::vector<std::uint8_t> picture = make_picture();
  const ImageView image{picture.data(), kShape};
  std::vector<std::uint8_t> mask(64 * 48);
  BlobFinder finder(kShape);
  std::size_t blobs = 0;
  double distance = 0.0;
  bool held = true;
  expect_realtime("ColourThreshold::holds", [&] { held = held && threshold.holds({230, 20, 20}); });
  expect_realtime("ColourThreshold::distance", [&] {
    distance += threshold.distance({0, 0, 255});
  });
  expect_realtime("ColourThreshold::mask", [&] { threshold.mask(image, mask); });
  expect_realtime("BlobFinder::find", [&] { blobs = finder.find(mask).size(); });
  EXPECT_TRUE(held);
  EXPECT_GT(distance, 0.0);
  EXPECT_EQ(blobs, 1u);
}

TEST(RealtimeVision, ABall) {
  auto made = BallFinder::make({.shape = kShape, .max_fill = 1.0});
  ASSERT_TRUE(made.ok()) << made.error();
  BallFinder finder = std::move(made).value();
  auto red = ColourThreshold::make({});
  ASSERT_TRUE(red.ok()) << red.error();
  const ColourThreshold threshold = std::move(red).value();
  const std::vector<std::uint8_t> picture = make_picture();
  bool found = true;
  expect_realtime("BallFinder::look_for", [&] { finder.look_for(threshold); });
  expect_realtime("BallFinder::find", [&] {
    found = found && finder.find({picture.data(), kShape}).has_value();
  });
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace armature::vision
