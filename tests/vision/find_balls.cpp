// SPDX-License-Identifier: Apache-2.0
// Looks for a ball in each image that comes: 160 x 120 pixels, red, green, blue, one image after
// the other. Says for each `PIXELS BLOBS none` or `PIXELS BLOBS X Y AREA CUT`.
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <optional>
#include <vector>

#include "armature/vision/ball_finder.hpp"

int main() {
  using armature::vision::BallFinder;
  // Shares at which no pixel can lie exactly, so that rounding decides nothing.
  const BallFinder::Config config{.shape = {160, 120},
                                  .colour = {.wanted = {255, 20, 10},
                                             .hue_tolerance_rad = 0.2,
                                             .min_saturation = 0.4137,
                                             .min_value = 0.1513},
                                  .min_area = 20};
  auto made = BallFinder::make(config);
  if (!made) {
    std::fprintf(stderr, "find_balls: %s\n", made.error().c_str());
    return 1;
  }
  BallFinder finder = std::move(made).value();
  std::vector<std::uint8_t> image(config.shape.bytes());
  while (std::fread(image.data(), 1, image.size(), stdin) == image.size()) {
    const std::optional<BallFinder::Ball> ball = finder.find({image.data(), config.shape});
    const int pixels = std::accumulate(finder.mask().begin(), finder.mask().end(), 0);
    std::printf("%d %zu ", pixels, finder.blobs().size());
    if (!ball) {
      std::printf("none\n");
    } else {
      std::printf("%.15g %.15g %d %d\n", ball->x, ball->y, ball->area, ball->cut ? 1 : 0);
    }
  }
}
