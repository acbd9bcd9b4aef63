// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "robots/janus/aic/aic_host.hpp"
#include "robots/janus/simulated_link.hpp"

namespace armature::janus {

/// The host on the bus of a simulated Janus: head, motors, encoders, brake and both cards with
/// their firmware, in this process and in simulated or real time, as the application is run.
///
/// Time passes for it when it is read, and at each Sample, also when nobody reads it any more.
class SimulatedJanus final : public AicHost {
 public:
  using AicHost::AicHost;

  /// Where a joint really is [rad], without an encoder's steps.
  /// @thread the component's own, or any while it does not run
  double position(std::size_t joint);
  /// For tests that break something: all there is, the host's own station on the bus, and its link.
  Simulation& simulation() { return link_->simulation(); }
  SimulatedLink& link() { return *link_; }
  can::VirtualStation& station() { return link_->station(); }

 private:
  base::Result<std::unique_ptr<can::Link>> make_link() override;
  void let_time_pass() { link_->begin_cycle(time()); }

  component::Property<std::string> urdf_{this, "robot_description", "", "file with the head's URDF",
                                         "",   component::mandatory};
  component::Property<double> inner_step_{
      this, "inner_step", 1e-4, "of the simulated motion", "s", component::range(1e-6, 1e-3)};

  component::EventHandler<> sample_{this,
                                    "Sample",
                                    component::serve<&SimulatedJanus::let_time_pass>,
                                    "time passes for it",
                                    component::optional,
                                    component::leads_to_nothing()};

  SimulatedLink* link_ = nullptr;
};

}  // namespace armature::janus
