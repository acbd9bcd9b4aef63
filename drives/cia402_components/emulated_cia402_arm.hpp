// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "drives/cia402/plant_arm.hpp"
#include "drives/cia402_components/emulated_cia402_host.hpp"

namespace armature::cia402 {

/// The host of emulated drives that move an arm, with gravity and all that one joint does to the
/// others: the first node its first joint, and so on. A drive gives at most the description's
/// effort.
class EmulatedCia402Arm final : public EmulatedCia402Host {
 public:
  using EmulatedCia402Host::EmulatedCia402Host;

 private:
  base::Result<void> add_load(EmulatedBus::Config& config) const override {
    auto arm =
        PlantArm{.file = robot_description_, .start = start_, .rotor_inertia = rotor_inertia_}
            .make();
    if (!arm) return base::Error{arm.error()};
    config.arm = std::move(arm).value();
    return {};
  }

  component::Property<std::string> robot_description_{
      this, "robot_description", "", "the file with the arm's description (URDF)",
      "",   component::mandatory};
  component::Property<std::vector<double>> start_{
      this,
      "start",
      {},
      "where each joint begins, and its drive's position is 0; none: at 0",
      "rad"};
  component::Property<double> rotor_inertia_{this,     "rotor_inertia",
                                             0.1,      "of each motor, at its joint",
                                             "kg m^2", component::range(1e-6, 1e6)};
};

}  // namespace armature::cia402
