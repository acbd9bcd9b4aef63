// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/control/transmission.hpp"
#include "robots/wam/driver/wam_driver.hpp"

namespace armature::wam {

/// How the joints are and move, from the positions that the pucks told. What a puck did not tell is
/// as it was: its position and its rate.
class WamMotion {
 public:
  /// @thread configuration only
  explicit WamMotion(control::Transmission transmission);

  /// Nothing is known of before.
  /// @rt nonblocking, no allocation
  void forget();
  /// Takes what the driver's last reading has.
  /// @param asked_at  when that was begun
  /// @rt nonblocking, no allocation, O(joints^2)
  void take(const WamDriver& driver, base::Time asked_at);

  /// Whether every motor has told its position.
  bool known() const { return known_; }
  std::span<const double> positions() const { return positions_; }    ///< [rad] of the joints
  std::span<const double> velocities() const { return velocities_; }  ///< [rad/s]

 private:
  struct Motor {
    bool known = false;
    base::Time asked_at{};
  };

  control::Transmission transmission_;
  bool known_ = false;
  std::vector<Motor> motors_;
  std::vector<double> angles_;
  std::vector<double> rates_;
  std::vector<double> positions_;
  std::vector<double> velocities_;
};

}  // namespace armature::wam
