// SPDX-License-Identifier: Apache-2.0
#include "armature/control/absolute_position.hpp"

#include <cmath>

#include "armature/control/internal/mistakes.hpp"

namespace armature::control {
namespace {

/// A joint at its largest velocity may overshoot that, and a sample may come late.
constexpr double kGenerous = 2.0;

}  // namespace

base::Result<AbsolutePosition> AbsolutePosition::make(const Config& config) {
  internal::Mistakes mistakes("AbsolutePosition");
  mistakes.expect(std::isfinite(config.ratio) && config.ratio != 0.0, "ratio", config.ratio,
                  "a finite number other than 0");
  mistakes.expect(std::isfinite(config.offset), "offset", config.offset, "a finite number");
  mistakes.expect_not_negative("range", config.range);
  mistakes.expect_positive("max_velocity", config.max_velocity);
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  return AbsolutePosition(config);
}

AbsolutePosition::Reading AbsolutePosition::step(double of_sensor, double elapsed_s) {
  const bool first = !known_;
  const double turned = within_range(first ? of_sensor : of_sensor - last_);
  Reading reading;
  if (first) {
    position_ = config_.offset + config_.ratio * turned;
  } else {
    reading.displacement = config_.ratio * turned;
    reading.possible = kGenerous * config_.max_velocity * elapsed_s;
    reading.jumped = std::abs(reading.displacement) > reading.possible;
    position_ += reading.displacement;
  }
  known_ = true;
  last_ = of_sensor;
  reading.position = position_;
  return reading;
}

void AbsolutePosition::shift(double by) {
  position_ += by;
  config_.offset = known_ ? position_ - config_.ratio * within_range(last_) : config_.offset + by;
}

double AbsolutePosition::within_range(double of_sensor) const {
  return config_.range > 0.0 ? std::remainder(of_sensor, config_.range) : of_sensor;
}

}  // namespace armature::control
