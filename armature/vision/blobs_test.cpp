// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/blobs.hpp"

#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"

namespace armature::vision {
namespace {

/// A mask as one draws it, a row after the other.
struct Drawn {
  explicit Drawn(const std::vector<std::string_view>& rows)
      : shape{static_cast<int>(rows.front().size()), static_cast<int>(rows.size())} {
    for (const std::string_view row : rows) {
      for (const char pixel : row) mask.push_back(pixel == '#' ? 1 : 0);
    }
  }
  ImageShape shape;
  std::vector<std::uint8_t> mask{};
};

std::vector<Blob> blobs_in(const std::vector<std::string_view>& rows) {
  const Drawn drawn(rows);
  BlobFinder finder(drawn.shape);
  const auto found = finder.find(drawn.mask);
  return {found.begin(), found.end()};
}

TEST(Blobs, AnEmptyMaskHasNone) { EXPECT_TRUE(blobs_in({"....", "...."}).empty()); }

TEST(Blobs, HaveAreaBoxAndCentre) {
  const auto blobs = blobs_in({
      ".....",
      "..##.",
      "..##.",
      "..##.",
  });
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_EQ(blobs[0].area, 6);
  EXPECT_EQ(blobs[0].box, (Box{2, 1, 4, 4}));
  EXPECT_EQ(blobs[0].x(), 3.0) << "the edge between the third and the fourth pixel";
  EXPECT_EQ(blobs[0].y(), 2.5);
  EXPECT_EQ(blobs[0].fill(), 1.0);
}

TEST(Blobs, TouchAtCornersToo) {
  EXPECT_EQ(blobs_in({"#..", ".#.", "..#"}).size(), 1u);
  EXPECT_EQ(blobs_in({"..#", ".#.", "#.."}).size(), 1u);
  EXPECT_EQ(blobs_in({"#..", "..#", "#.."}).size(), 3u);
}

TEST(Blobs, WhatAUnitesBelowIsOneWithAllItsPixels) {
  const auto blobs = blobs_in({
      "#.#.#.#",
      "#.#.#.#",
      "#######",
  });
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_EQ(blobs[0].area, 15);
  EXPECT_EQ(blobs[0].box, (Box{0, 0, 7, 3}));
  EXPECT_EQ(blobs[0].x(), 3.5);
}

TEST(Blobs, ASpiralIsOneAndWhatLiesWithinIsAnother) {
  const auto blobs = blobs_in({
      "#########",
      "#.......#",
      "#.#####.#",
      "#.#...#.#",
      "#.#.#.#.#",
      "#.#...#.#",
      "#.###.#.#",
      "#.....#.#",
      "#######.#",
  });
  EXPECT_THAT(blobs, ::testing::SizeIs(2));
  EXPECT_EQ(blobs.back().area, 1);
  EXPECT_EQ(blobs.back().box, (Box{4, 4, 5, 5}));
}

TEST(Blobs, RunsSayWhoseTheyAre) {
  const Drawn drawn({"##..#", "....#"});
  BlobFinder finder(drawn.shape);
  const auto blobs = finder.find(drawn.mask);
  ASSERT_EQ(blobs.size(), 2u);
  ASSERT_EQ(finder.runs().size(), 3u);
  EXPECT_EQ(finder.runs()[0].blob, 0);
  EXPECT_EQ(finder.runs()[1].blob, 1);
  EXPECT_EQ(finder.runs()[2].blob, 1);
}

TEST(Blobs, TheNextMaskBeginsAnew) {
  const Drawn full({"##", "##"});
  const Drawn empty({"..", ".."});
  BlobFinder finder(full.shape);
  EXPECT_EQ(finder.find(full.mask).size(), 1u);
  EXPECT_EQ(finder.find(empty.mask).size(), 0u);
  EXPECT_EQ(finder.find(full.mask).size(), 1u);
}

/// Points that do not touch, stripes, and a comb whose teeth unite in its last row.
TEST(Blobs, TheWorstMasksNeedNoMemory) {
  constexpr int kSize = 63;
  const auto mask_of = [](auto&& is_set) {
    std::vector<std::uint8_t> mask;
    for (int i = 0; i < kSize * kSize; ++i) mask.push_back(is_set(i % kSize, i / kSize) ? 1 : 0);
    return mask;
  };
  const auto points = mask_of([](int x, int y) { return x % 2 == 0 && y % 2 == 0; });
  const auto stripes = mask_of([](int x, int) { return x % 2 == 0; });
  const auto comb = mask_of([](int x, int y) { return x % 2 == 0 || y == kSize - 1; });
  BlobFinder finder({kSize, kSize});
  const ::armature::testing::RealtimeGuard guard;
  const std::size_t of_points = finder.find(points).size();
  const std::size_t of_stripes = finder.find(stripes).size();
  const std::size_t of_comb = finder.find(comb).size();
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_EQ(of_points, 32u * 32u);
  EXPECT_EQ(of_stripes, 32u);
  EXPECT_EQ(of_comb, 1u);
}

}  // namespace
}  // namespace armature::vision
