// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "drives/cia402/emulated_arm.hpp"

namespace armature::cia402 {

/// The joints of a robot's description (URDF) as what emulated drives move, with gravity and with
/// all that one joint does to the others.
struct PlantArm {
  std::string file;             ///< joints that turn, one after the other
  std::vector<double> start{};  ///< [rad], one each; none: where the description has 0
  double rotor_inertia = 0.1;   ///< [kg m2] of each motor, at its joint; above 0

  /// An error names the file, and what is wrong in it.
  base::Result<std::unique_ptr<EmulatedArm>> make() const;
};

}  // namespace armature::cia402
