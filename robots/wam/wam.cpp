// SPDX-License-Identifier: Apache-2.0
// The component library `wam`: what is particular to the arm.
#include "armature/component/registry.hpp"
#include "robots/wam/actuator_wam.hpp"
#include "robots/wam/controller_wam.hpp"
#include "robots/wam/sensor_wam.hpp"
#include "robots/wam/wam_hardware.hpp"

using namespace armature::wam;
using armature::component::Granularity;

ARMATURE_COMPONENT_LIBRARY(wam, registry) {
  registry.add<ActuatorWam>("ActuatorWAM", "the actuators of the arm", Granularity::kAtomic);
  registry.add<ControllerWam>("ControllerWAM", "the arm's own controller of its joints");
  registry.add<SensorWam>("SensorWAM", "the sensors of the arm", Granularity::kAtomic);
  registry.add<WamHardware>("WamHardware", "the arm: its bus, its pucks and its safety board",
                            Granularity::kAtomic);
}
