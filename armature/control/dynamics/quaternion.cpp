// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/quaternion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace armature::control {

/// Divides by the largest of the four, so that nothing is lost near a half turn.
std::array<double, 4> quaternion_of(const std::array<double, 9>& rotation,
                                    const std::array<double, 4>& near) {
  const auto r = [&](std::size_t row, std::size_t column) { return rotation[3 * row + column]; };
  const double trace = r(0, 0) + r(1, 1) + r(2, 2);
  std::array<double, 4> made{};
  std::size_t largest = 0;
  for (const std::size_t axis : {std::size_t{1}, std::size_t{2}}) {
    if (r(axis, axis) > r(largest, largest)) largest = axis;
  }
  if (trace > r(largest, largest)) {
    made = {r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1), 1.0 + trace};
  } else {
    const std::size_t i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
    made[i] = 1.0 + r(i, i) - r(j, j) - r(k, k);
    made[j] = r(i, j) + r(j, i);
    made[k] = r(i, k) + r(k, i);
    made[3] = r(k, j) - r(j, k);
  }
  double square = 0.0;
  double side = 0.0;
  for (std::size_t each = 0; each < made.size(); ++each) {
    square += made[each] * made[each];
    side += made[each] * near[each];
  }
  const double scale = std::copysign(1.0 / std::sqrt(square), side);
  for (double& each : made) each *= scale;
  return made;
}

}  // namespace armature::control
