// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace armature::control {

/// The unit quaternion [x, y, z, w] of a rotation.
/// @param rotation  of v_base = R v_link, row by row
/// @param near      the answer lies on its side: of the two quaternions of a rotation, the nearer
/// @rt nonblocking, no allocation
std::array<double, 4> quaternion_of(const std::array<double, 9>& rotation,
                                    const std::array<double, 4>& near = {0.0, 0.0, 0.0, 1.0});

}  // namespace armature::control
