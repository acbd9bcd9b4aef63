// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/sim/plant.hpp"

namespace armature::sim {

/// An electromagnetic brake on a joint of a plant: springs apply it, current releases it. So it is
/// applied at the beginning.
class Brake {
 public:
  /// @param plant           outlives the brake
  /// @param holding_torque  [N m] at the joint, > 0; against more it slips
  Brake(Plant& plant, std::size_t joint, double holding_torque)
      : plant_(plant), joint_(joint), holding_torque_(holding_torque) {
    apply();
  }

  /// @rt nonblocking, no allocation
  void apply() { set(true); }
  /// @rt nonblocking, no allocation
  void release() { set(false); }
  bool applied() const { return applied_; }

 private:
  void set(bool applied) {
    applied_ = applied;
    plant_.set_brake(joint_, applied ? holding_torque_ : 0.0);
  }

  Plant& plant_;
  std::size_t joint_;
  double holding_torque_;
  bool applied_ = false;
};

}  // namespace armature::sim
