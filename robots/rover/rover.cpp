// SPDX-License-Identifier: Apache-2.0
// The component library `rover`: the components of paper 4's robot.
#include "armature/component/registry.hpp"
#include "robots/rover/vision/vision.hpp"

using namespace armature::rover;

ARMATURE_COMPONENT_LIBRARY(rover, registry) {
  constexpr const char* kVision = "recognises a ball by its colour in the images of a camera";
  registry.add<Vision>("Vision", kVision);
  // To other programs a component has the interface of its model's name, and rover.idl says VS.
  registry.add<Vision>("VS", kVision);
}
