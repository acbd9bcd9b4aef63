// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/simulated_janus.hpp"

#include <chrono>

#include "armature/platform/clock.hpp"

namespace armature::janus {

double SimulatedJanus::position(std::size_t joint) {
  Simulation& simulation = link_->simulation();
  return simulation.head().position(joint, simulation.now());
}

base::Result<std::unique_ptr<AicLink>> SimulatedJanus::make_link() {
  const Head::Config head{.urdf_file = urdf_,
                          .inner_step = std::chrono::duration_cast<base::Duration>(
                              std::chrono::duration<double>(inner_step_.get()))};
  const bool simulated = context().simulated;
  auto made = SimulatedLink::make(
      head, simulated ? SimulatedLink::Time::kSimulated : SimulatedLink::Time::kReal,
      simulated ? time() : platform::monotonic_now());
  if (!made) return base::Error{made.error()};
  link_ = made.value().get();
  return std::unique_ptr<AicLink>(std::move(made).value());
}

}  // namespace armature::janus
