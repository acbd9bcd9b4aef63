// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/encoder.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace armature::sim {

Encoder::Encoder(double counts_per_turn, double gear_ratio)
    : counts_per_rad_(counts_per_turn * gear_ratio / (2.0 * std::numbers::pi)) {}

std::int64_t Encoder::count(double position) const {
  return static_cast<std::int64_t>(std::floor(position * counts_per_rad_ + 0.5));
}

std::int64_t Encoder::displacement(double position) {
  const std::int64_t now = count(position);
  return now - std::exchange(last_, now);
}

}  // namespace armature::sim
