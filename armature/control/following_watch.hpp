// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "armature/base/time.hpp"

namespace armature::control {

/// Watches a drive that controls a joint by itself: whether the joint does what the drive is told.
/// It only judges; whoever asks brakes. One thread uses it.
class FollowingWatch {
 public:
  /// In the unit of the command.
  struct Config {
    double max_error = 0.0;     ///< > 0
    base::Duration patience{};  ///< for which the error may be larger, >= 0
  };

  FollowingWatch() = default;
  explicit FollowingWatch(const Config& config) : config_(config) {}

  /// The drive has been told nothing yet.
  /// @rt nonblocking, no allocation
  void reset() { beyond_since_ = kNever; }

  /// @param error  of the joint from what the drive was told last
  /// @return false: it is too large, and has been for longer than allowed; also of what is no
  /// number
  /// @rt nonblocking, no allocation
  bool step(double error, base::Time now) {
    if (std::abs(error) <= config_.max_error) {
      reset();
      return true;
    }
    if (beyond_since_ == kNever) beyond_since_ = now;
    return now - beyond_since_ < config_.patience;
  }

 private:
  static constexpr base::Time kNever = base::Time::min();

  Config config_;
  base::Time beyond_since_ = kNever;
};

}  // namespace armature::control
