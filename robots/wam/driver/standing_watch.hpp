// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/outcome.hpp"
#include "armature/control/arming/holding_watch.hpp"

namespace armature::wam {

/// Watches the arm while it is to stand: first it comes to rest, on which way no joint may become
/// much faster than the fastest was at the beginning, go farther than that one needs to stop, or be
/// shaken; then a HoldingWatch judges each joint.
class StandingWatch {
 public:
  /// One number for each joint.
  struct Config {
    std::vector<double> max_motion;    ///< [rad] away from where it came to rest, > 0
    std::vector<double> max_velocity;  ///< [rad/s] > 0
    std::vector<double> max_torque;    ///< [N m] that holds it without its weight, > 0
    double max_alternation = 0.2;      ///< share of cycles in which such a torque changes its sign
    double period_s = 0.0;             ///< > 0
    std::vector<double> max_acceleration{};  ///< [rad/s^2] that it is braked with, > 0
  };

  /// An error names what is wrong.
  static base::Result<StandingWatch> make(const Config& config);

  /// From now on it is to stand, from as fast as it is; nothing happens if it already is.
  /// @rt nonblocking, no allocation, as all below
  void stand(std::span<const double> velocities);
  /// From now on it may move.
  void move();

  /// Once a cycle.
  /// @param torques  [N m] that hold it, without its weight
  /// @return why it has to be braked, if it has to
  std::optional<component::Reason> step(std::span<const double> positions,
                                        std::span<const double> velocities,
                                        std::span<const double> torques);

 private:
  enum class Phase { kMayMove, kSettling, kStanding };

  StandingWatch(const Config& config, std::vector<control::HoldingWatch> joints);

  std::optional<component::Reason> settle(std::span<const double> velocities,
                                          std::span<const double> torques);
  control::HoldingWatch::Finding judge_braking(std::size_t joint, double speed, double torque);

  Config config_;
  std::vector<control::HoldingWatch> joints_;
  Phase phase_ = Phase::kMayMove;
  double fastest_ = 0.0;     ///< [rad/s] when it began to come to rest
  double settling_s_ = 0.0;  ///< since then
  double at_rest_s_ = 0.0;   ///< without a break
  std::vector<int> fast_cycles_;
  std::vector<double> way_;  ///< [rad] of each joint since then
};

}  // namespace armature::wam
