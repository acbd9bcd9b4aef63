// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/described_type.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

namespace armature::ros2::internal {
namespace {

enum class Side : std::uint16_t { kLeft, kRight = 700 };
ARMATURE_ENUM(Side, kLeft, kRight);

struct Mark {
  std::int8_t before = 0;
  double x = 0.0;
  base::FixedText<5> label{};
};
ARMATURE_STRUCT(Mark, before, x, label);

struct Everything {
  bool on = false;
  Side side = Side::kLeft;
  Mark mark{};
  std::array<Mark, 2> marks{};
  std::vector<Mark> more{};
  std::vector<std::vector<float>> rows{};
  std::array<std::array<std::int16_t, 3>, 2> matrix{};
  std::uint64_t end = 0;
};
ARMATURE_STRUCT(Everything, on, side, mark, marks, more, rows, matrix, end);

TEST(DescribedType, WhatBecameACValueIsReadBack) {
  Everything written;
  written.on = true;
  written.side = Side::kRight;
  written.mark = {-3, 0.5, std::string_view("abcde")};
  written.marks[1] = {4, 1.5, std::string_view("")};
  written.more = {{5, 2.5, std::string_view("x")}, {6, 3.5, std::string_view("yz")}};
  written.rows = {{1.0f, 2.0f}, {}, {3.0f}};
  written.matrix[1] = {7, 8, 9};
  written.end = 1ull << 60;
  DescribedType type(types::type_of<Everything>());
  Everything read;
  type.read(type.sample_of(&written), &read);
  EXPECT_EQ(types::to_text(types::type_of<Everything>(), &read),
            types::to_text(types::type_of<Everything>(), &written));
}

TEST(DescribedType, OfAVectorIsReadBackAlsoWhenItIsEmpty) {
  DescribedType type(types::type_of<std::vector<double>>());
  std::vector<double> read;
  for (const std::vector<double>& written : {std::vector<double>{1.0, 2.0}, {}, {3.0}}) {
    type.read(type.sample_of(&written), &read);
    EXPECT_EQ(read, written);
  }
}

}  // namespace
}  // namespace armature::ros2::internal
