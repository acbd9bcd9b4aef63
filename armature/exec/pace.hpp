// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace armature::exec {

/// The rate of a simulation that waits for nothing.
inline constexpr double kAsFastAsPossible = std::numeric_limits<double>::infinity();

/// How simulated time passes.
struct Pace {
  double rate = kAsFastAsPossible;  ///< simulated seconds in a second, above 0
  bool paused = false;

  /// It is not as fast as the machine can.
  bool waits() const { return paused || rate != kAsFastAsPossible; }

  bool operator==(const Pace&) const = default;
};

}  // namespace armature::exec
