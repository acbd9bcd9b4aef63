// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drives/cia402_components/cia402_host.hpp"
#include "drives/cia402_components/emulated_link.hpp"

namespace armature::cia402 {

/// The host of emulated drives in this process, each with an axis of its own, in simulated or real
/// time, as the application is run. Their nodes follow each other.
class EmulatedCia402Bus final : public Cia402Host {
 public:
  using Cia402Host::Cia402Host;

  /// For tests that break something.
  /// @thread the component's own, or any while it does not run
  EmulatedBus& drives() { return link_->drives(); }
  can::VirtualStation& station() { return link_->station(); }

 private:
  base::Result<std::unique_ptr<can::Link>> make_link() override;

  component::Property<double> inertia_{this,           "inertia", 0.25,
                                       "of each axis", "kg m^2",  component::range(1e-6, 1e6)};
  component::Property<double> viscous_friction_{
      this, "viscous_friction", 0.1, "of each axis", "Nm s/rad", component::range(0.0, 1e6)};

  EmulatedLink* link_ = nullptr;
};

}  // namespace armature::cia402
