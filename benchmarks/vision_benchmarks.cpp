// SPDX-License-Identifier: Apache-2.0
// What it takes to find a ball in an image, as the rover's camera sends them.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "armature/vision/ball_finder.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr std::int64_t kRounds = 301;
constexpr double kBound = 500'000.0;  // [ns]
constexpr vision::ImageShape kShape{320, 240};

/// A checkered floor, an orange post, a blue box and a red ball.
vision::Rgb colour_at(int column, int row) {
  if ((column - 160) * (column - 160) + (row - 120) * (row - 120) < 13 * 13) return {210, 40, 40};
  if (column > 40 && column < 70 && row < 180) return {230, 130, 20};
  if (column > 220 && column < 290 && row > 60 && row < 130) return {30, 60, 200};
  const std::uint8_t grey = (column / 20 + row / 20) % 2 == 0 ? 90 : 140;
  return {grey, grey, grey};
}

/// The bytes of an image with noise.
std::vector<std::uint8_t> scene() {
  vision::Image image(kShape);
  for (int row = 0; row < kShape.height; ++row) {
    for (int column = 0; column < kShape.width; ++column)
      image.set(column, row, colour_at(column, row));
  }
  std::vector<std::uint8_t> bytes = image.bytes();
  std::mt19937 source(1);
  std::normal_distribution<double> noise(0.0, 6.0);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(std::clamp(byte + noise(source), 0.0, 255.0));
  }
  return bytes;
}

void find_ball(benchmark::State& state) {
  const std::vector<std::uint8_t> image = scene();
  std::vector<std::uint8_t> copy(image.size());
  auto finder = vision::BallFinder::make({.shape = kShape});
  if (!finder) return state.SkipWithError(finder.error().c_str());
  if (!finder.value().find({image.data(), kShape})) return state.SkipWithError("no ball is found");
  Result result = measure_in_turn(
      state,
      [&](std::int64_t count) {
        for (; count > 0; --count) {
          benchmark::DoNotOptimize(finder.value().find({image.data(), kShape}));
        }
      },
      [&](std::int64_t count) {
        for (; count > 0; --count) {
          std::memcpy(copy.data(), image.data(), image.size());
          benchmark::ClobberMemory();
        }
      });
  result.bound = value_at_most(kBound);
  publish(state, result);
}

}  // namespace

void add_vision(const Suite& suite) { suite.add("find_ball", kRounds, find_ball); }

}  // namespace armature::benchmarks
