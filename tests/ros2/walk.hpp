// SPDX-License-Identifier: Apache-2.0
#pragma once

// A port of all kinds of types; walk.idl is what `armature models --dds` writes of it.

#include <array>
#include <cstdint>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

namespace armature::ros2 {

enum class Way : std::uint8_t { kLeft, kRight };
ARMATURE_ENUM(Way, kLeft, kRight);

struct Spot {
  double x = 0.0;
  float y = 0.0f;
};
ARMATURE_STRUCT(Spot, (x, "m"), y);

struct Walk {
  bool on = false;
  Way way = Way::kLeft;
  std::int8_t small = 0;
  std::uint16_t steps = 0;
  std::int64_t large = 0;
  Spot begin{};
  std::array<Spot, 2> ends{};
  std::vector<Spot> between{};
  base::FixedText<15> name{};
  std::array<std::array<std::int16_t, 3>, 2> matrix{};
  std::vector<double> numbers{};
};
ARMATURE_STRUCT(Walk, on, way, small, steps, large, begin, ends, between, name, matrix, numbers);

}  // namespace armature::ros2
