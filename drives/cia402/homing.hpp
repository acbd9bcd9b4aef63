// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace armature::cia402 {

/// Toward which end an axis moves first.
enum class HomingDirection : std::uint8_t { kNone, kNegative, kPositive };

/// What ends the search.
enum class HomingMark : std::uint8_t {
  kHere,           ///< nothing: the axis does not move
  kNegativeLimit,  ///< the negative limit switch
  kPositiveLimit,  ///< the positive limit switch
  kHomeSwitch,     ///< an edge of the home switch
  kNothing,        ///< no switch: the index alone
};

/// A homing method of 0x6098 (CiA 402-2, chapter 11).
struct HomingMethod {
  std::int8_t number;
  HomingMark mark;
  HomingDirection first;  ///< direction
  bool with_index;        ///< the next index pulse behind the mark is home
};

/// All methods that CiA 402 has.
std::span<const HomingMethod> homing_methods() noexcept;
/// The method of that number; none if CiA 402 reserves it or leaves it to makers.
std::optional<HomingMethod> find_homing_method(std::int8_t number) noexcept;

}  // namespace armature::cia402
