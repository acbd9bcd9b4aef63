// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/control/dc_motor.hpp"

// What the simulated rover is made of; where the numbers come from is in MODEL.md.
namespace armature::rover {

constexpr double kTrack = 0.30;        ///< between the middles of left and right wheels [m]
constexpr double kWheelRadius = 0.05;  ///< [m]
constexpr double kSupplyVoltage = 12.0;
constexpr double kCountsPerTurn = 2000.0;  ///< of the motor
constexpr double kBallRadius = 0.05;       ///< [m]

/// Where the rover begins: 1 m before the ball's place, which its camera has in the middle.
constexpr double kBeginX = -1.5;
constexpr double kCameraAhead = 0.08;   ///< of the middle of the front axle [m]
constexpr double kCameraHeight = 0.30;  ///< above the floor [m]
constexpr double kBallRestX = -0.42;

/// Of each wheel; the friction is the description's.
constexpr control::DcMotor::Config kMotor{.resistance_ohm = 4.0,
                                          .torque_constant = 0.025,
                                          .gear_ratio = 20.0,
                                          .viscous_friction = 0.0,
                                          .coulomb_friction = 0.0,
                                          .coulomb_velocity = 0.0,
                                          .rotor_inertia = 5e-6};

}  // namespace armature::rover
