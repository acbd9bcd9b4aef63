// SPDX-License-Identifier: Apache-2.0
// The component library `record`: what a deployment records with.
#include "armature/component/registry.hpp"
#include "armature/general/reporter/reporter.hpp"

using namespace armature::general;

ARMATURE_COMPONENT_LIBRARY(record, registry) {
  registry.add<Reporter>("Reporter", "records ports, properties and components");
}
