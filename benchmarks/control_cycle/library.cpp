// SPDX-License-Identifier: Apache-2.0
// What cycle.yaml needs besides the library `robot`.
#include "benchmarks/control_cycle/stand_ins.hpp"

using namespace armature::benchmarks;

ARMATURE_COMPONENT_LIBRARY(control_cycle, registry) {
  registry.add<Card>("Card", "a simulated motor");
  registry.add<Reference>("CycleReference", "where the joints are to be");
}
