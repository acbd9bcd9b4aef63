// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drives/cia402_components/cia402_host.hpp"
#include "drives/cia402_components/emulated_link.hpp"

namespace armature::cia402 {

/// The host of emulated drives in this process, in simulated or real time, as the application is
/// run: to be extended by what they move. Their nodes follow each other.
class EmulatedCia402Host : public Cia402Host {
 public:
  using Cia402Host::Cia402Host;

  /// For tests that break something.
  /// @thread the component's own, or any while it does not run
  EmulatedBus& drives() { return link_->drives(); }
  can::VirtualStation& station() { return link_->station(); }

 protected:
  /// Says in `config` what the drives move.
  virtual base::Result<void> add_load(EmulatedBus::Config& config) const = 0;

 private:
  base::Result<std::unique_ptr<can::Link>> make_link() override;

  EmulatedLink* link_ = nullptr;
};

}  // namespace armature::cia402
