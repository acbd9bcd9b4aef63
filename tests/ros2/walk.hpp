// SPDX-License-Identifier: Apache-2.0
#pragma once

// Ports of all kinds of types; walk.idl is what `armature models --dds` writes of them.

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
  base::FixedText<15> name{};
  std::array<std::array<std::int16_t, 3>, 2> matrix{};
};
ARMATURE_STRUCT(Walk, on, way, small, steps, large, begin, ends, name, matrix);

/// With vectors inside: it can be written to a topic, and not be read.
struct Hike {
  Walk walk{};
  std::vector<Spot> between{};
  std::vector<double> numbers{};
};
ARMATURE_STRUCT(Hike, walk, between, numbers);

}  // namespace armature::ros2
