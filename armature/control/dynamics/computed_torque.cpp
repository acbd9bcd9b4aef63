// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/computed_torque.hpp"

#include <algorithm>
#include <utility>

#include "armature/control/internal/gains.hpp"

namespace armature::control {

base::Result<ComputedTorque> ComputedTorque::make(InverseDynamics links, Transmission rotors,
                                                  const Config& config) {
  internal::Gains gains("ComputedTorque", links.joints());
  gains.expect_joints("rotors", rotors.joints());
  gains.expect("kp", config.kp);
  gains.expect("kd", config.kd);
  if (const auto checked = gains.result(); !checked) return base::Error{checked.error()};
  return ComputedTorque(std::move(links), std::move(rotors), config);
}

ComputedTorque::ComputedTorque(InverseDynamics links, Transmission rotors, const Config& config)
    : links_(std::move(links)),
      rotors_(std::move(rotors)),
      config_(config),
      motion_(3 * links_.joints()) {}

bool ComputedTorque::step(std::span<const double> reference, std::span<const double> measured,
                          std::span<double> torques) {
  const std::size_t count = joints();
  if (reference.size() != 3 * count || measured.size() != 2 * count || torques.size() != count) {
    return false;
  }
  std::copy(measured.begin(), measured.end(), motion_.begin());
  const std::span<double> accelerations = std::span(motion_).subspan(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    accelerations[i] = reference[2 * count + i] +
                       config_.kd[i] * (reference[count + i] - measured[count + i]) +
                       config_.kp[i] * (reference[i] - measured[i]);
  }
  links_.step(motion_, torques);
  rotors_.add_rotor_torques(reference.subspan(count, count), accelerations, torques);
  return true;
}

}  // namespace armature::control
