// SPDX-License-Identifier: Apache-2.0
// The component library `rover`: the components of paper 4's robot.
#include "armature/component/registry.hpp"
#include "robots/rover/vision/vision.hpp"

using namespace armature::rover;

ARMATURE_COMPONENT_LIBRARY(rover, registry) {
  registry.add<Vision>("Vision", "recognises a ball by its colour in the images of a camera");
}
