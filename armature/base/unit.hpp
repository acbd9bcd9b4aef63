// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::base {

/// A physical unit: the power of each base dimension and the factor to the base unit.
/// Angle and "count" are dimensions of their own, so that rad is not confused with a plain number,
/// nor rad/s with Hz.
struct Unit {
  /// Base dimensions, in the order of `powers`; kDimensions is their number.
  enum Dimension { kLength, kMass, kTime, kCurrent, kTemperature, kAngle, kCount, kDimensions };

  std::array<int, kDimensions> powers{};
  double factor = 1.0;  ///< value in base units = value * factor

  bool same_kind(const Unit& other) const { return powers == other.powers; }
  /// A number in one is the same number in the other.
  bool same_as(const Unit& other) const { return same_kind(other) && factor == other.factor; }
};

/// Reads a unit such as `ms`, `deg`, `V/rad`, `rad/s^2`, `N m`, `kg*m^2`; empty text is a plain
/// number.
Result<Unit> parse_unit(std::string_view text);

/// A number with the unit behind it, as users write it: `10 ms`, `45deg`, `0.5`.
struct Quantity {
  double value = 0.0;
  std::string unit;  ///< empty if none was written
};
Result<Quantity> parse_quantity(std::string_view text);

/// `value` given in `from`, expressed in `to`; an error names both if they are of different kinds.
Result<double> convert(double value, std::string_view from, std::string_view to);

}  // namespace armature::base
