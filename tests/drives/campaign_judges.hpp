// SPDX-License-Identifier: Apache-2.0
// What is always so, whatever breaks: judged on what drives were told and on the simulated axes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "drives/cia402/objects.hpp"
#include "tests/drives/campaign_arm.hpp"

namespace armature::cia402 {

/// Looks in each cycle at the targets that drives follow. Shares of what the deployment allows.
class TargetWatch {
 public:
  void look_at(CampaignArm& arm) {
    for (std::size_t i = 0; i < CampaignArm::kJoints; ++i) judge(arm.drive(i), places_[i]);
    speed_ = std::max(speed_, arm.fastest() / kMostVelocity);
  }

  double largest() const { return largest_; }
  /// Of positions, from one cycle to the next; of what MaxVelocity allows.
  double largest_step() const { return step_; }
  /// Of an axis, whatever its drive was told.
  double largest_speed() const { return speed_; }

 private:
  // Of examples/12_cia402.
  static constexpr double kMostTorque = 20.0;      ///< [N m]
  static constexpr double kMostVelocity = 2.0;     ///< [rad/s]
  static constexpr double kMostPosition = 1.5708;  ///< [rad]
  static constexpr double kCycle = 0.002;          ///< [s]
  struct Place {
    bool followed = false;
    double target = 0.0;
  };

  void judge(const EmulatedDrive& drive, Place& place) {
    const bool followed =
        std::exchange(place.followed, drive.power() == PowerState::kOperationEnabled);
    if (!place.followed) return;
    const auto& objects = drive.device().dictionary();
    const Scaling& scaling = drive.scaling();
    double share = 0.0;
    if (drive.mode() == Mode::kCyclicTorque) {
      share = scaling.torque(objects.number(object::kTargetTorque)) / kMostTorque;
    } else if (drive.mode() == Mode::kCyclicVelocity) {
      share = scaling.velocity(objects.number(object::kTargetVelocity)) / kMostVelocity;
    } else {
      const double target = scaling.position(objects.number(object::kTargetPosition));
      if (followed) {
        step_ = std::max(step_, std::abs(target - place.target) / (kMostVelocity * kCycle));
      }
      place.target = target;
      share = target / kMostPosition;
    }
    largest_ = std::max(largest_, std::abs(share));
  }

  std::array<Place, CampaignArm::kJoints> places_{};
  double largest_ = 0.0;
  double step_ = 0.0;
  double speed_ = 0.0;
};

/// Looks at an arm that is to stand, from its first look on.
class RestWatch {
 public:
  void forget() { rests_.clear(); }
  void look_at(CampaignArm& arm) {
    if (rests_.empty()) rests_ = arm.positions();
    moved_ = std::max(moved_, largest_apart(arm.positions(), rests_));
    enabled_ += arm.any_enabled() ? 1 : 0;
  }

  /// By the joint that moved most [rad].
  double moved() const { return moved_; }
  /// Cycles in which a drive was enabled.
  int enabled() const { return enabled_; }

 private:
  Vector rests_;
  double moved_ = 0.0;
  int enabled_ = 0;
};

}  // namespace armature::cia402
