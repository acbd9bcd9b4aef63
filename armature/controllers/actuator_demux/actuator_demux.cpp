// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/actuator_demux/actuator_demux.hpp"

#include <algorithm>
#include <cmath>

#include "armature/component/face.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

void ActuatorNDemux::actuate(const std::vector<double>& act) {
  const auto wrong =
      std::find_if_not(act.begin(), act.end(), [](double signal) { return std::isfinite(signal); });
  if (wrong != act.end()) {
    component::Reason why("the control signal of joint ");
    append_number(why, static_cast<double>(wrong - act.begin() + 1)).append(" is ");
    fault(append_number(why, *wrong).append(", expected a finite number"));
    return;
  }
  for (std::size_t i = 0; i < act.size(); ++i) commands_[i].write(act[i]);
  if (take_sample()) act_.raise();
}

/// Without those of which nobody knows anything there would be others in their places.
std::vector<DrivenJoint> ActuatorNDemux::joints_behind(const component::InputPortBase* /*input*/,
                                                       const component::Check& check) {
  std::vector<DrivenJoint> all;
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    const std::vector<DrivenJoint>& joints = controllers::joints_behind(face(commands_[i]), check);
    if (joints.size() != 1) return {};
    all.push_back(joints.front());
  }
  return all;
}

}  // namespace armature::controllers
