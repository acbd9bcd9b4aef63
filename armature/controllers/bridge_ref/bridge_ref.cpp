// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/bridge_ref/bridge_ref.hpp"

#include <algorithm>

#include "armature/component/face.hpp"

namespace armature::controllers {

using component::Outcome;

Outcome BridgeRef::on_configure() {
  const auto joints = static_cast<std::size_t>(joints_.get());
  positions_.assign(joints, 0.0);
  composed_.assign(kParts * joints, 0.0);
  return component::accepted();
}

Outcome BridgeRef::on_start() {
  std::fill(std::begin(arrived_), std::end(arrived_), false);
  return component::accepted();
}

void BridgeRef::on_sensor(const std::vector<double>& sensor) {
  std::copy_n(sensor.begin(), positions_.size(), positions_.begin());
  sensor_position_.write(positions_);
}

void BridgeRef::take(Part part, const std::vector<double>& desired) {
  std::copy(desired.begin(), desired.end(), composed_.data() + part * positions_.size());
  arrived_[part] = true;
  if (!std::all_of(std::begin(arrived_), std::end(arrived_), [](bool came) { return came; })) {
    return;
  }
  std::fill(std::begin(arrived_), std::end(arrived_), false);
  reference_.write(composed_);
}

std::vector<DrivenJoint> BridgeRef::joints_behind(const component::InputPortBase* input,
                                                  const component::Check& check) {
  return input == &face(position_) ? controllers::joints_behind(face(reference_), check)
                                   : std::vector<DrivenJoint>{};
}

}  // namespace armature::controllers
