// SPDX-License-Identifier: Apache-2.0
#pragma once

// What counts as shaking: the same whether the arm stands or is driven.

#include <chrono>

#include "armature/base/seconds.hpp"
#include "armature/control/arming/holding_watch.hpp"

namespace armature::wam::internal {

/// Of the largest torque: less drives nothing, it is the noise of encoders.
inline constexpr double kLeastDriving = 0.1;

/// One joint's watch, as far as it is about torques that change their signs.
/// @param max_torque       [N m]
/// @param max_alternation  share of the cycles
inline control::HoldingWatch::Config shaking_config(double period_s, double max_torque,
                                                    double max_alternation) {
  control::HoldingWatch::Config config;
  config.period = base::from_seconds(period_s);
  config.least_effort = kLeastDriving * max_torque;
  config.max_alternation = max_alternation;
  config.alternation_time = std::chrono::milliseconds(40);
  return config;
}

}  // namespace armature::wam::internal
