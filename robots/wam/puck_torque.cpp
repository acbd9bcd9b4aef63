// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/puck_torque.hpp"

#include <cmath>

#include "robots/wam/puck_protocol.hpp"

namespace armature::wam {

std::int16_t PuckTorque::next() {
  if (is_zero()) return 0;
  const double whole = std::floor(wanted_);
  rest_ += wanted_ - whole;
  if (rest_ < 1.0) return torque_value(whole);
  rest_ -= 1.0;
  return torque_value(whole + 1.0);
}

}  // namespace armature::wam
