// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/scaling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace armature::cia402 {
namespace {

/// The nearest number of that type; what is not finite becomes 0.
template <typename Raw>
Raw nearest(double value) noexcept {
  if (!std::isfinite(value)) return 0;
  constexpr double kLow = std::numeric_limits<Raw>::min();
  constexpr double kHigh = std::numeric_limits<Raw>::max();
  return static_cast<Raw>(std::clamp(std::round(value), kLow, kHigh));
}

struct NamedFactor {
  const char* object;
  std::uint32_t value;
};

}  // namespace

base::Result<Scaling> Scaling::make(const Factors& factors, PositionUnit unit) {
  const std::array named = {
      NamedFactor{"0x608F:01, encoder increments", factors.encoder_increments},
      NamedFactor{"0x608F:02, motor revolutions", factors.motor_revolutions},
      NamedFactor{"0x6091:01, motor revolutions", factors.gear_motor},
      NamedFactor{"0x6091:02, shaft revolutions", factors.gear_shaft},
      NamedFactor{"0x6092:01, feed", factors.feed},
      NamedFactor{"0x6092:02, shaft revolutions", factors.feed_shaft},
      NamedFactor{"0x6076, rated torque", factors.rated_torque_mNm},
      NamedFactor{"0x6075, rated current", factors.rated_current_mA}};
  for (const NamedFactor& factor : named) {
    if (factor.value > 0) continue;
    return base::Error{"object " + std::string(factor.object) +
                       " is 0, expected a number above 0 (set it in the drive)"};
  }
  const double ratio = static_cast<double>(factors.gear_motor) / factors.gear_shaft;
  const double units_per_revolution =
      unit == PositionUnit::kFeed
          ? static_cast<double>(factors.feed) / factors.feed_shaft
          : static_cast<double>(factors.encoder_increments) / factors.motor_revolutions * ratio;
  Scaling scaling;
  scaling.radians_per_unit_ = 2.0 * std::numbers::pi / units_per_revolution;
  scaling.torque_per_thousandth_ = factors.rated_torque_mNm * 1e-6 * ratio;
  scaling.current_per_thousandth_ = factors.rated_current_mA * 1e-6;
  return scaling;
}

std::int32_t Scaling::raw_position(double position_rad) const noexcept {
  return nearest<std::int32_t>(position_rad / radians_per_unit_);
}

std::int16_t Scaling::raw_torque(double torque_Nm) const noexcept {
  return nearest<std::int16_t>(torque_Nm / torque_per_thousandth_);
}

}  // namespace armature::cia402
