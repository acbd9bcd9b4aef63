// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wam_motion.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::wam {

WamMotion::WamMotion(control::Transmission transmission)
    : transmission_(std::move(transmission)), motors_(transmission_.joints()) {
  for (auto* numbers : {&angles_, &rates_, &positions_, &velocities_}) {
    numbers->assign(transmission_.joints(), 0.0);
  }
}

void WamMotion::forget() {
  known_ = false;
  std::ranges::fill(motors_, Motor{});
  std::ranges::fill(rates_, 0.0);
}

void WamMotion::take(const WamDriver& driver, base::Time asked_at) {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const WamMotor& told = driver.motor(i);
    if (!told.fresh) continue;
    const double passed = base::to_seconds(asked_at - motors_[i].asked_at);
    const bool moved = motors_[i].known && passed > 0.0;
    rates_[i] = moved ? (told.position - angles_[i]) / passed : 0.0;
    angles_[i] = told.position;
    motors_[i] = {true, asked_at};
  }
  known_ = std::ranges::all_of(motors_, &Motor::known);
  transmission_.joint_angles(angles_, positions_);
  transmission_.joint_angles(rates_, velocities_);
}

}  // namespace armature::wam
