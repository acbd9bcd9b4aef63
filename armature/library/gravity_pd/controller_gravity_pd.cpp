// SPDX-License-Identifier: Apache-2.0
#include "armature/library/gravity_pd/controller_gravity_pd.hpp"

#include <utility>

#include "armature/control/per_joint.hpp"

namespace armature::library {

base::Result<void> ControllerGravityPD::make_law(control::InverseDynamics links) {
  const auto kp = control::per_joint(kp_.name(), kp_.get(), joints());
  if (!kp) return base::Error{kp.error()};
  const auto kd = control::per_joint(kd_.name(), kd_.get(), joints());
  if (!kd) return base::Error{kd.error()};
  auto made = control::GravityPd::make(std::move(links), {.kp = kp.value(), .kd = kd.value()});
  if (!made) return base::Error{made.error()};
  law_ = std::move(made).value();
  return {};
}

void ControllerGravityPD::compute(std::span<const double> reference, std::span<const double> motion,
                                  std::span<double> torques) {
  law_->step(reference, motion, torques);
}

}  // namespace armature::library
