// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/simulated_janus.hpp"

#include <chrono>

namespace armature::janus {

double SimulatedJanus::position(std::size_t joint) {
  Simulation& simulation = link_->simulation();
  return simulation.head().position(joint, simulation.now());
}

base::Result<std::unique_ptr<AicLink>> SimulatedJanus::make_link() {
  const Head::Config head{.urdf_file = urdf_,
                          .inner_step = std::chrono::duration_cast<base::Duration>(
                              std::chrono::duration<double>(inner_step_.get()))};
  auto made = SimulatedLink::make(
      head, context().simulated ? SimulatedLink::Time::kSimulated : SimulatedLink::Time::kReal);
  if (!made) return base::Error{made.error()};
  link_ = made.value().get();
  return std::unique_ptr<AicLink>(std::move(made).value());
}

}  // namespace armature::janus
