// SPDX-License-Identifier: Apache-2.0
// The component library `rover`: the ball-tracking robot of paper 4, and its arena, simulated.
#include "armature/component/registry.hpp"
#include "robots/rover/ball.hpp"
#include "robots/rover/camera.hpp"
#include "robots/rover/chassis_drive.hpp"
#include "robots/rover/simulated_rover.hpp"
#include "robots/rover/vision/vision.hpp"
#include "robots/rover/wheel.hpp"

using namespace armature::rover;
using armature::component::Granularity;

// To other programs a component has the interface of its model's name: table 4 of the paper says VS
// and Chassis.
ARMATURE_COMPONENT_LIBRARY(rover, registry) {
  registry.add<SimulatedRover>(
      "SimulatedRover", "the simulated rover in its arena, with its drives", Granularity::kAtomic);
  registry.add<Wheel>("RoverWheel", "a wheel with its motor and encoder: the hardware of a joint",
                      Granularity::kAtomic);
  registry.add<Camera>("Camera", "the images of the camera on the rover's mast",
                       Granularity::kAtomic);
  registry.add<Ball>("Ball", "the ball, on a way that is chosen", Granularity::kAtomic);
  registry.add<ChassisDrive>("ChassisDrive", "drives the wheels of both sides: setVelocity",
                             {{"Chassis"}});
  registry.add<Vision>("Vision", "recognises a ball by its colour in the images of a camera",
                       {{"VS"}});
}
