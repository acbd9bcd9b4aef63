// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/outcome.hpp"
#include "armature/control/arming/holding_watch.hpp"

namespace armature::wam {

/// Watches the armed arm, whatever drives it: any controller, any generator of references. Neither
/// a joint nor the tip is too fast, and no torque shakes. While the arm is to stand no
/// controller drives a joint away from its place; a joint that nothing drives, because the arm is
/// weightless, may be led by hand, but not sink on and on.
class DrivenWatch {
 public:
  /// One number for each joint where it is a vector.
  struct Config {
    std::vector<double> max_velocity;  ///< [rad/s] > 0
    std::vector<double> max_torque;    ///< [N m] of commands, without the weight; > 0
    double max_tip = 0.0;              ///< [m/s] of the tip, > 0
    double max_driven = 0.0;       ///< [rad] that a controller drives a joint off its place, > 0
    double max_sinking = 0.0;      ///< [rad] that a joint sinks without a break, > 0
    double max_alternation = 0.2;  ///< share of cycles in which a torque changes its sign
    double period_s = 0.0;         ///< > 0
  };
  /// Of a cycle; torques are those of the cycle before, which have moved the arm since.
  struct Measured {
    std::span<const double> positions;   ///< [rad]
    std::span<const double> velocities;  ///< [rad/s]
    std::span<const double> torques;     ///< [N m] that move it, without its weight
    std::span<const double> weight;      ///< [N m] that hold it
    double tip = 0.0;                    ///< [m/s]
  };

  /// An error names what is wrong.
  static base::Result<DrivenWatch> make(const Config& config);

  /// It was armed: nothing of before counts.
  /// @rt nonblocking, no allocation, as all below
  void begin();
  /// From now on it is to stand, where it is in the next cycle.
  void rest();
  /// From now on it may move.
  void move() { rests_ = false; }

  /// Once a cycle.
  /// @return why the controller has to be cut off, if it has to
  std::optional<component::Reason> step(const Measured& measured);

 private:
  struct Joint {
    control::HoldingWatch shaking;
    int fast_cycles = 0;
    int driven_cycles = 0;  ///< in a row, away from its place
    double place = 0.0;     ///< [rad] where it is to stand
    double sunk = 0.0;      ///< [rad] without a break
    double pause_s = 0.0;   ///< since it sank last
  };

  DrivenWatch(const Config& config, std::vector<Joint> joints)
      : config_(config), joints_(std::move(joints)) {}

  double predict_tip(double speed);
  std::optional<component::Reason> judge(std::size_t index, const Measured& measured);
  std::optional<component::Reason> judge_standing(std::size_t index, const Measured& measured);

  Config config_;
  std::vector<Joint> joints_;
  bool rests_ = false;
  static constexpr std::size_t kMean = 5;  ///< cycles, against the steps of encoders
  std::array<double, 2 * kMean> tip_{};    ///< speeds of the last cycles [m/s]
  std::size_t next_tip_ = 0;
  bool placed_ = false;  ///< since it rests
};

}  // namespace armature::wam
