// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>

#include "armature/base/time.hpp"

namespace armature::base {

/// Seconds as formulas, properties and people have them.
constexpr double to_seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// The nearest whole number of nanoseconds.
/// @param seconds  finite, within the range of Duration
inline Duration from_seconds(double seconds) { return Duration(std::llround(seconds * 1e9)); }

}  // namespace armature::base
