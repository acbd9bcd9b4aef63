// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drives/cia402_components/emulated_cia402_host.hpp"

namespace armature::cia402 {

/// The host of emulated drives, each with an axis of its own.
class EmulatedCia402Bus final : public EmulatedCia402Host {
 public:
  using EmulatedCia402Host::EmulatedCia402Host;

 private:
  base::Result<void> add_load(EmulatedBus::Config& config) const override {
    config.drive.axis.inertia = inertia_;
    config.drive.axis.viscous = viscous_friction_;
    return {};
  }

  component::Property<double> inertia_{this,           "inertia", 0.25,
                                       "of each axis", "kg m^2",  component::range(1e-6, 1e6)};
  component::Property<double> viscous_friction_{
      this, "viscous_friction", 0.1, "of each axis", "Nm s/rad", component::range(0.0, 1e6)};
};

}  // namespace armature::cia402
