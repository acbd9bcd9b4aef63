// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

// For tests: a struct with a field of every kind that types/ describes.

namespace armature::types {

/// A struct with units.
struct Pose {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const Pose&, const Pose&) = default;
};
ARMATURE_STRUCT(Pose, (x, "m", "ahead of the dock"), (y, "m"));

/// An enumeration whose numbers have gaps.
enum class Gait : std::int16_t { kStanding, kWalking = 300, kTurningOnTheSpot = -2 };
ARMATURE_ENUM(Gait, kStanding, kWalking, kTurningOnTheSpot);

/// Has every kind of field, and padding between them.
struct Everything {
  bool on = false;
  std::int8_t i8 = 0;
  std::uint8_t u8 = 0;
  std::int16_t i16 = 0;
  std::uint16_t u16 = 0;
  std::int32_t i32 = 0;
  std::uint32_t u32 = 0;
  std::int64_t i64 = 0;
  std::uint64_t u64 = 0;
  float f = 0.0f;
  double d = 0.0;
  Gait gait = Gait::kStanding;
  std::string text;
  base::FixedText<5> label;
  std::array<bool, 3> flags{};
  std::vector<float> q;
  Pose pose;
  std::vector<Pose> path;
  std::vector<std::string> names;
  std::array<std::vector<std::uint16_t>, 2> tables;
  friend bool operator==(const Everything&, const Everything&) = default;
};
ARMATURE_STRUCT(Everything, on, i8, u8, i16, u16, i32, u32, i64, u64, f, d, gait, text, label,
                flags, q, pose, path, names, tables);

inline Everything make_everything() {
  Everything value;
  value.on = true;
  value.i8 = -128;
  value.u8 = 255;
  value.i16 = -32768;
  value.u16 = 65535;
  value.i32 = -2147483647 - 1;
  value.u32 = 4294967295u;
  value.i64 = -9223372036854775807 - 1;
  value.u64 = 18446744073709551615u;
  value.f = 0.1f;
  value.d = -1.0 / 3.0;
  value.gait = Gait::kTurningOnTheSpot;
  value.text = "line\n\"quoted\" \\ tab\t bell\x07 zero" + std::string(1, '\0') + "µ";
  value.label = "abcde";
  value.flags = {true, false, true};
  value.q = {1.5f, -2.5e-30f};
  value.pose = {1.0, -2.0};
  value.path = {{1.0, 2.0}, {3.0, 4.0}, {1e300, 5e-324}};
  value.names = {"", "a, b", "]}"};
  value.tables = {std::vector<std::uint16_t>{}, std::vector<std::uint16_t>{1, 2, 3}};
  return value;
}

}  // namespace armature::types
