// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/gravity_pd/controller_gravity_pd.hpp"

#include <utility>

#include "armature/control/per_joint.hpp"

namespace armature::controllers {

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

std::string ControllerGravityPD::objection(const std::vector<DrivenJoint>& joints, double period_s,
                                           const CheckedGains::Wanted& wanted) const {
  const auto kp = control::per_joint(kp_.name(), wanted.value_of(kp_), joints.size());
  if (!kp) return kp.error();
  const auto kd = control::per_joint(kd_.name(), wanted.value_of(kd_), joints.size());
  if (!kd) return kd.error();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto loop = loop_of(kp.value()[i], kd.value()[i], period_s, wanted);
    std::string wrong =
        objection_to_gains(joints[i], control::SampledController::of(loop), period_s);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace armature::controllers
