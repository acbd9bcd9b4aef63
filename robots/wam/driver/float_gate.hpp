// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "armature/component/outcome.hpp"

namespace armature::wam {

/// Decides whether an arm that is held may be let float: once it has been at rest for a second, and
/// only if its description knows what it weighs. What else holds a joint is a load, which would
/// pull the arm down as soon as nothing but the weight is driven.
class FloatGate {
 public:
  struct Config {
    std::vector<double> max_load;  ///< [N m] of each joint, > 0
    double period_s = 0.0;         ///< > 0
  };
  enum class Verdict {
    kNone,      ///< nothing is decided yet, or it has been already
    kMayFloat,  ///< this once
    kStays,     ///< this once; see `why`
  };

  explicit FloatGate(Config config)
      : config_(std::move(config)), sums_(config_.max_load.size(), 0.0) {}

  /// From now on it is held, and may be let float; nothing of before counts.
  /// @rt nonblocking, no allocation, as all below
  void begin();
  /// It will not be let float until `begin`.
  void close() { open_ = false; }

  /// Once a cycle, while it is held.
  /// @param velocities  [rad/s]
  /// @param torques     [N m] that hold it, without its weight
  Verdict step(std::span<const double> velocities, std::span<const double> torques);
  /// Why it stays held.
  component::Reason why() const;

 private:
  void forget();

  Config config_;
  bool open_ = false;
  std::vector<double> sums_;  ///< of torques, since it is at rest
  int cycles_ = 0;
  std::size_t loaded_ = 0;  ///< the joint that keeps it held
  double load_ = 0.0;       ///< [N m] of that
};

}  // namespace armature::wam
