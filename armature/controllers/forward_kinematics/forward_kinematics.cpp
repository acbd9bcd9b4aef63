// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/forward_kinematics/forward_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/control/dynamics/quaternion.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;

Outcome ForwardKinematics::on_configure() {
  base::Diagnostics diagnostics;
  auto loaded = control::ForwardKinematics::load(
      file_, {.base_link = base_link_, .tip_link = tip_link_}, diagnostics);
  if (!loaded || !diagnostics.ok()) {
    return component::refused(file_.get() + ": " + base::as_reason(diagnostics));
  }
  if (loaded->joints() != static_cast<std::size_t>(joints_.get())) {
    return component::refused(
        file_.get() + " moves " + std::to_string(loaded->joints()) +
        " joints up to its tip, expected joints = " + std::to_string(joints_.get()));
  }
  kinematics_ = std::move(loaded);
  last_ = {};
  return component::accepted();
}

void ForwardKinematics::compute(const std::vector<double>& positions) {
  const auto wrong = std::ranges::find_if_not(positions, [](double q) { return std::isfinite(q); });
  if (wrong != positions.end()) {
    component::Reason why("the position of joint ");
    append_number(why, static_cast<double>(wrong - positions.begin() + 1)).append(" is ");
    return fault(append_number(why, *wrong).append(", expected a finite number"));
  }
  control::Pose tip;
  if (!kinematics_->step(positions, tip)) return;  // the size is declared
  const Quaternion& before = last_.orientation;
  const auto [x, y, z, w] =
      control::quaternion_of(tip.rotation, {before.x, before.y, before.z, before.w});
  last_ = {{tip.position[0], tip.position[1], tip.position[2]}, {x, y, z, w}};
  pose_.write(last_);
}

}  // namespace armature::controllers
