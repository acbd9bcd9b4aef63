// SPDX-License-Identifier: Apache-2.0
// The component library `rover`: the ball-tracking rover of paper 4, simulated.
#include "armature/component/registry.hpp"
#include "robots/rover/ball.hpp"
#include "robots/rover/camera.hpp"
#include "robots/rover/chassis_drive.hpp"
#include "robots/rover/simulated_rover.hpp"
#include "robots/rover/wheel.hpp"

using namespace armature::rover;

ARMATURE_COMPONENT_LIBRARY(rover, registry) {
  registry.add<SimulatedRover>("SimulatedRover",
                               "the simulated rover in its arena, with its drives");
  registry.add<Wheel>("RoverWheel", "a wheel with its motor and encoder: the hardware of a joint");
  registry.add<Camera>("Camera", "the images of the camera on the rover's mast");
  registry.add<Ball>("Ball", "the ball, on a way that is chosen");
  registry.add<ChassisDrive>("ChassisDrive", "drives the wheels of both sides: setVelocity",
                             {{"Chassis"}});  // as table 4 of paper 4 calls the interface
}
