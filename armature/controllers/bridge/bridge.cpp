// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/bridge/bridge.hpp"

#include <algorithm>

#include "armature/component/face.hpp"

namespace armature::controllers {

component::Outcome Bridge::on_configure() {
  measured_.assign(position_.size(), 0.0);
  came_.assign(position_.size(), false);
  return component::accepted();
}

component::Outcome Bridge::on_start() {
  std::fill(came_.begin(), came_.end(), false);
  missing_ = came_.size();
  return component::accepted();
}

void Bridge::on_position(std::size_t joint, double position) {
  measured_[joint] = position;
  if (!came_[joint]) {
    came_[joint] = true;
    --missing_;
  }
  if (missing_ == 0) positions_.write(measured_);
}

void Bridge::on_desired(const Vector& desired) {
  for (std::size_t i = 0; i < desired.size(); ++i) ref_[i].write(desired[i]);
}

std::vector<DrivenJoint> Bridge::joints_behind(const component::InputPortBase* input,
                                               const component::Check& check) {
  std::vector<DrivenJoint> all;
  if (input != &face(desired_)) return all;
  for (std::size_t i = 0; i < ref_.size(); ++i) {
    const std::vector<DrivenJoint>& joints = controllers::joints_behind(face(ref_[i]), check);
    if (joints.size() != 1) return {};
    all.push_back(joints.front());
  }
  return all;
}

}  // namespace armature::controllers
