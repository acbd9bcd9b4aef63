// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "drives/cia402/drive_group.hpp"

namespace armature::cia402 {

/// Watches a drive in mode torque: whether it gives the torque that it was told, and whether what
/// it tells is new. A controller that believes old values drives the joint on and on.
class TorqueWatch {
 public:
  enum class Finding {
    kGood,
    kDisobeys,  ///< for more than ten cycles in a row another torque than it was told
    kFrozen,    ///< as long the same values to the bit, although it was told another torque
  };

  /// Once a cycle.
  /// @param target  that it was told [N m]
  /// @param rated   its torque [N m]
  /// @rt nonblocking, no allocation
  Finding step(const DriveState& drive, double target, double rated) {
    if (!drive.enabled()) return *this = TorqueWatch(), Finding::kGood;
    const bool obeys = std::abs(drive.effort - target) <= kMostError * rated;
    disobeyed_ = obeys ? 0 : disobeyed_ + 1;
    look_for_news(drive, target, kToldOther * rated);
    if (disobeyed_ > kMostCycles) return Finding::kDisobeys;
    return unanswered_ > kMostCycles ? Finding::kFrozen : Finding::kGood;
  }

 private:
  /// Of the rated torque, by which a drive may miss its target for as many cycles: two until it
  /// acts, and what currents take to grow.
  static constexpr double kMostError = 0.05;
  /// Of the rated torque: what a drive shows that does as it is told.
  static constexpr double kToldOther = 0.01;
  static constexpr int kMostCycles = 10;

  void look_for_news(const DriveState& drive, double target, double other) {
    if (drive.time == last_.time) return;  // no answer is somebody else's to judge
    const bool same = drive.position == last_.position && drive.velocity == last_.velocity &&
                      drive.effort == last_.effort;
    last_ = {drive.time, drive.position, drive.velocity, drive.effort};
    lowest_ = same ? std::min(lowest_, target) : target;
    highest_ = same ? std::max(highest_, target) : target;
    unanswered_ = highest_ - lowest_ > other ? unanswered_ + 1 : 0;
  }

  struct Told {
    base::Time time{};
    double position = 0.0;
    double velocity = 0.0;
    double effort = 0.0;
  };

  Told last_;
  double lowest_ = 0.0;  ///< target since its answers are the same
  double highest_ = 0.0;
  int unanswered_ = 0;  ///< answers in a row, the same although another torque was told
  int disobeyed_ = 0;   ///< cycles in a row
};

}  // namespace armature::cia402
