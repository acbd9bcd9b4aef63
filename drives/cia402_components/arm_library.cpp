// SPDX-License-Identifier: Apache-2.0
// The component library `cia402_arm`: emulated drives that move a simulated arm. Apart from
// `cia402`, so that an arm of iron does without the simulation.
#include "armature/component/registry.hpp"
#include "drives/cia402_components/emulated_cia402_arm.hpp"

using namespace armature::cia402;
using armature::component::Granularity;

ARMATURE_COMPONENT_LIBRARY(cia402_arm, registry) {
  registry.add<EmulatedCia402Arm>("EmulatedCia402Arm",
                                  "the host of emulated drives by CiA 402 that move an arm",
                                  Granularity::kAtomic);
}
