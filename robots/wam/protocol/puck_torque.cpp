// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/protocol/puck_torque.hpp"

#include <algorithm>
#include <cmath>

#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {
namespace {

/// [units] in a frame: slower than any limit of growth by far.
constexpr double kSlow = 4.0;
/// [units] What fast torques have not let through is made up for, but not for ever.
constexpr double kMostRest = 8.0;

}  // namespace

std::int16_t PuckTorque::next() {
  if (is_zero()) {
    last_ = {};
    return 0;
  }
  const double whole = std::floor(wanted_);
  const double part = wanted_ - whole;
  rest_ = std::clamp(rest_ + part, -kMostRest, kMostRest);
  last_ = {wanted_, part, rounds_up(part)};
  if (last_.up) rest_ -= 1.0;
  return torque_value(last_.up ? whole + 1.0 : whole);
}

/// From down to up the frame steps by 1 + last part - part beyond what was wanted, from up to down
/// by as much less.
bool PuckTorque::rounds_up(double part) const {
  if (part == 0.0) return false;
  const bool due = rest_ >= 1.0;
  if (due == last_.up || std::abs(wanted_ - last_.wanted) < kSlow) return due;
  return due ? part >= last_.part : part > last_.part;
}

}  // namespace armature::wam
