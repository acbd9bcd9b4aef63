// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace armature::rover {

/// The arena with the rover, as MuJoCo's description (MJCF): the bodies `rover`, `wheel1` to
/// `wheelN` and `ball`, the joints `axle1` to `axleN`, the camera `eye`. x is to the front where
/// the rover begins, y to the left, z upwards; wheels with odd numbers are on the left.
/// @param wheels  2, with a caster behind; or 4
std::string description(int wheels);

}  // namespace armature::rover
