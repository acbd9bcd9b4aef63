// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/gravity_pd.hpp"

#include <utility>

#include "armature/control/internal/gains.hpp"

namespace armature::control {

base::Result<GravityPd> GravityPd::make(InverseDynamics links, const Config& config) {
  internal::Gains gains("GravityPd", links.joints());
  gains.expect("kp", config.kp);
  gains.expect("kd", config.kd);
  if (const auto checked = gains.result(); !checked) return base::Error{checked.error()};
  return GravityPd(std::move(links), config);
}

GravityPd::GravityPd(InverseDynamics links, const Config& config)
    : links_(std::move(links)), config_(config) {}

bool GravityPd::step(std::span<const double> reference, std::span<const double> measured,
                     std::span<double> torques) {
  const std::size_t count = joints();
  if (reference.size() != 3 * count || measured.size() != 2 * count || torques.size() != count) {
    return false;
  }
  links_.gravity(measured.first(count), torques);
  for (std::size_t i = 0; i < count; ++i) {
    torques[i] += config_.kp[i] * (reference[i] - measured[i]) +
                  config_.kd[i] * (reference[count + i] - measured[count + i]);
  }
  return true;
}

}  // namespace armature::control
