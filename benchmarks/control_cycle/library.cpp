// SPDX-License-Identifier: Apache-2.0
// The control cycle as a component library, for the program `armature` and cycle.yaml.
#include "benchmarks/control_cycle/components.hpp"

using namespace armature::benchmarks;

ARMATURE_COMPONENT_LIBRARY(control_cycle, registry) {
  registry.add<Sampler>("Sampler", "starts a cycle in each of its periods");
  registry.add<Card>("Card", "a simulated motor");
  registry.add<Joint>("Joint", "signs, ratio and offset of a joint");
  registry.add<SensorNMux>("SensorNMux", "makes one vector of what the joints measured");
  registry.add<Reference>("Reference", "where the joints are to be");
  registry.add<ControllerNPid>("ControllerNPID", "an independent PID for each joint");
  registry.add<Pid>("PID", "one-joint PID");
  registry.add<ActuatorNDemux>("ActuatorNDemux", "hands out the control signals");
}
