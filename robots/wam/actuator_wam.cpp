// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/actuator_wam.hpp"

#include <cmath>

#include "armature/component/face.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::wam {

void ActuatorWam::actuate(const std::vector<double>& act) {
  const bool sampled = take_sample();
  for (std::size_t i = 0; i < act.size(); ++i) {
    if (std::isfinite(act[i])) continue;
    component::Reason why("the torque for joint ");
    controllers::append_number(why, static_cast<double>(i + 1)).append(" is ");
    return fault(controllers::append_number(why, act[i]).append(", expected finite numbers"));
  }
  if (!sampled) return unsampled_.assign(unsampled_ + 1);
  torque_.write(act);
}

std::vector<controllers::DrivenJoint> ActuatorWam::joints_behind(
    const component::InputPortBase* /*input*/, const component::Check& check) {
  return controllers::joints_behind(face(torque_), check);
}

}  // namespace armature::wam
