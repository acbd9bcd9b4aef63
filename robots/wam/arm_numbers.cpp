// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/arm_numbers.hpp"

#include <numbers>

namespace armature::wam {
namespace {

constexpr double kPerRpm = 60.0 / (2.0 * std::numbers::pi);  ///< from N m/rpm to N m s/rad
constexpr MotorNumbers kMotorA{0.457, 3.473};
constexpr MotorNumbers kMotorB{0.236, 6.213};
constexpr MotorNumbers kMotorC{0.067, 5.205};
constexpr double kFrictionA = 7.549e-5 * kPerRpm;
constexpr double kFrictionB = 8.899e-6 * kPerRpm;
constexpr double kFrictionC = 1.259e-6 * kPerRpm;

// Turns of motors for one of their joint. A differential's second joint has a ratio of its own in
// the shoulder: 28.25 / 1.68, which the vendor rounds.
constexpr double kBase = 42.0;
constexpr double kShoulder = 28.25;
constexpr double kTwist = 16.8155;
constexpr double kElbow = 18.0;
constexpr double kWrist = 9.7;
constexpr double kRoll = 14.93;

}  // namespace

const ArmNumbers& wam7() {
  static const ArmNumbers numbers{
      .urdf = "wam7.urdf",
      .transmission = {.turns = {-kBase, 0,          0,       0,       0,      0,       0,  //
                                 0,      kShoulder,  -kTwist, 0,       0,      0,       0,  //
                                 0,      -kShoulder, -kTwist, 0,       0,      0,       0,  //
                                 0,      0,          0,       -kElbow, 0,      0,       0,  //
                                 0,      0,          0,       0,       kWrist, -kWrist, 0,  //
                                 0,      0,          0,       0,       kWrist, kWrist,  0,  //
                                 0,      0,          0,       0,       0,      0,       -kRoll},
                       .rotor_inertia = {1.1631e-4, 1.1831e-4, 1.1831e-4, 1.0686e-4, 1.685e-5,
                                         1.745e-5, 1.42e-6},
                       .viscous_friction = {kFrictionA, kFrictionA, kFrictionA, kFrictionA,
                                            kFrictionB, kFrictionB, kFrictionC}},
      .home = {0.0, -2.0, 0.0, 3.13, 0.0, 0.0, 0.0},
      .motors = {kMotorA, kMotorA, kMotorA, kMotorA, kMotorB, kMotorB, kMotorC},
      .gains = {{900, 2.5, 10, 25},
                {2500, 5, 20, 20},
                {600, 2, 5, 15},
                {500, 0.5, 2, 15},
                {50, 0.5, 0.5, 5},
                {50, 0.5, 0.5, 5},
                {8, 0.1, 0.05, 5}}};
  return numbers;
}

const ArmNumbers& wam4() {
  static const ArmNumbers numbers{
      .urdf = "wam4.urdf",
      .transmission = {.turns = {-kBase, 0, 0, 0,            //
                                 0, kShoulder, -kTwist, 0,   //
                                 0, -kShoulder, -kTwist, 0,  //
                                 0, 0, 0, -kElbow},
                       .rotor_inertia = {1.1631e-4, 1.1831e-4, 1.1831e-4, 1.0686e-4},
                       .viscous_friction = {kFrictionA, kFrictionA, kFrictionA, kFrictionA}},
      .home = {0.0, -2.0, 0.0, 3.13},
      .motors = {kMotorA, kMotorA, kMotorA, kMotorA},
      .gains = {{900, 2.5, 10, 25}, {2500, 5, 20, 20}, {600, 2.5, 10, 15}, {500, 0.5, 2.5, 15}}};
  return numbers;
}

}  // namespace armature::wam
