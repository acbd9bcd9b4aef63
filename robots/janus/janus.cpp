// SPDX-License-Identifier: Apache-2.0
// The component library `janus`: the head's hardware, real and simulated.
#include "armature/component/registry.hpp"
#include "robots/janus/aic/aic.hpp"
#include "robots/janus/aic/aic_bus.hpp"
#include "robots/janus/simulated_janus.hpp"

using namespace armature::janus;
using armature::component::Granularity;

ARMATURE_COMPONENT_LIBRARY(janus, registry) {
  registry.add<Aic>("AIC", "an AIC card: the hardware of a joint", Granularity::kAtomic);
  registry.add<AicWithGear>("AICCard", "an AIC card with the properties of paper 2, section 5.1",
                            Granularity::kAtomic);
  registry.add<AicBus>("AICBus", "the host of AIC cards on a CAN interface", Granularity::kAtomic);
  registry.add<SimulatedJanus>(
      "SimulatedJanus", "the simulated head with its cards, and their host", Granularity::kAtomic);
}
