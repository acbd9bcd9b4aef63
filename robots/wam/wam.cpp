// SPDX-License-Identifier: Apache-2.0
// The component library `wam`: what is particular to the arm.
#include "armature/component/registry.hpp"
#include "robots/wam/controller_wam.hpp"

using namespace armature::wam;

ARMATURE_COMPONENT_LIBRARY(wam, registry) {
  registry.add<ControllerWam>("ControllerWAM", "the arm's own controller of its joints");
}
