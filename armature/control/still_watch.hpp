// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace armature::control {

/// Watches the sensor of a joint that a drive moves by itself: a position that stays the same to
/// the bit while the joint is told to go elsewhere is none, or the joint is blocked. It only
/// judges; whoever asks brakes. A sensor may tell each position ten times. One thread uses it.
class StillWatch {
 public:
  /// What a joint may do.
  struct Config {
    double most = 0.0;  ///< way that a joint may be told to go meanwhile [rad or m], > 0
    /// After which a way counts for a part e of itself. Infinite for positions; velocities that a
    /// drive rounds to none would add up for ever.
    double memory = std::numeric_limits<double>::infinity();  ///< [s], > 0
  };

  StillWatch() = default;
  explicit StillWatch(const Config& config) : config_(config) {}

  /// The drive has been told nothing yet.
  /// @rt nonblocking, no allocation
  void reset() {
    same_ = 0;
    way_ = 0.0;
  }

  /// @param position  that was measured
  /// @param way       that the joint was told to go since the last step
  /// @param period_s  since then
  /// @return false: the position has not changed, and it should have; also of what is no number
  /// @rt nonblocking, no allocation
  bool step(double position, double way, double period_s) {
    if (position != position_) {
      reset();
      position_ = position;
      return std::isfinite(position);
    }
    ++same_;
    way_ += way - way_ * std::min(1.0, period_s / config_.memory);
    return same_ <= kMostSame || std::abs(way_) <= config_.most;
  }

 private:
  static constexpr int kMostSame = 10;

  Config config_;
  int same_ = 0;  ///< samples in a row
  double position_ = 0.0;
  double way_ = 0.0;
};

}  // namespace armature::control
