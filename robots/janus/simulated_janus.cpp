// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/simulated_janus.hpp"

#include <string>

#include "armature/base/seconds.hpp"
#include "armature/platform/clock.hpp"

namespace armature::janus {

double SimulatedJanus::position(std::size_t joint) {
  Simulation& simulation = link_->simulation();
  return simulation.head().position(joint, simulation.now());
}

base::Result<std::unique_ptr<can::Link>> SimulatedJanus::make_link() {
  for (const int number : cards()) {
    if (number >= 1 && number <= static_cast<int>(kJoints)) continue;
    return base::Error{"cards has " + std::to_string(number) +
                       ", expected 1 or 2: the head has two"};
  }
  const Head::Config head{.urdf_file = urdf_, .inner_step = base::from_seconds(inner_step_)};
  const bool simulated = is_simulated();
  auto made = SimulatedLink::make(
      head, simulated ? SimulatedLink::Time::kSimulated : SimulatedLink::Time::kReal,
      simulated ? time() : platform::monotonic_now());
  if (!made) return base::Error{made.error()};
  link_ = made.value().get();
  return std::unique_ptr<can::Link>(std::move(made).value());
}

}  // namespace armature::janus
