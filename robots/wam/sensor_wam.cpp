// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/sensor_wam.hpp"

namespace armature::wam {

component::Outcome SensorWam::on_configure() {
  if (component::Outcome outcome = period_.known(); !outcome) return outcome;
  measured_.assign(2 * static_cast<std::size_t>(joints_.get()), 0.0);
  unread_.assign(0);
  return component::accepted();
}

void SensorWam::sample_now() {
  const auto read = read_();
  if (!read || !read.value) unread_.assign(unread_ + 1);
}

void SensorWam::on_data(const Vector& data) {
  const std::size_t joints = measured_.size() / 2;
  const double period_s = period_.seconds();
  for (std::size_t i = 0; i < joints; ++i) {
    measured_[i] = data[i];
    measured_[joints + i] = data[joints + i] * period_s;
  }
  sensor_.write(measured_);
}

}  // namespace armature::wam
