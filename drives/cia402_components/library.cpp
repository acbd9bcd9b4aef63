// SPDX-License-Identifier: Apache-2.0
// The component library `cia402`: drives that one can buy, on CANopen.
#include "armature/component/registry.hpp"
#include "drives/cia402_components/cia402_bus.hpp"
#include "drives/cia402_components/cia402_drive.hpp"
#include "drives/cia402_components/emulated_cia402_bus.hpp"

using namespace armature::cia402;
using armature::component::Granularity;

ARMATURE_COMPONENT_LIBRARY(cia402, registry) {
  registry.add<Cia402Bus>("Cia402Bus", "the host of drives by CiA 402 on a CAN bus",
                          Granularity::kAtomic);
  registry.add<EmulatedCia402Bus>("EmulatedCia402Bus", "the host of emulated drives by CiA 402",
                                  Granularity::kAtomic);
  registry.add<Cia402Drive>("Cia402Drive", "a drive by CiA 402, the hardware of a joint",
                            Granularity::kAtomic);
}
