// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "armature/control/dynamics/gravity_pd.hpp"
#include "armature/controllers/base/controller_of_model.hpp"

namespace armature::controllers {

/// Compensation of gravity by the robot's description and a PD controller for each joint (paper 3,
/// conclusion): control::GravityPd, in the place of another Controller. Gains are one number for
/// each joint, or one for all. Where the hardware compensates gravity itself, `gravity` is 0.
/// @rt nonblocking, no allocation, O(joints)
class ControllerGravityPD final : public ControllerOfModel {
 public:
  using ControllerOfModel::ControllerOfModel;

 private:
  base::Result<void> make_law(control::InverseDynamics links) override;
  bool take_change() override { return changes_.take(); }
  void compute(std::span<const double> reference, std::span<const double> motion,
               std::span<double> torques) override;

  std::string objection(const std::vector<DrivenJoint>& joints, double period_s,
                        const CheckedGains::Wanted& wanted) const;

  using Numbers = component::Property<std::vector<double>>;
  Numbers kp_{this,
              "Kp",
              {},
              "torque for an error",
              "Nm/rad",
              component::mandatory,
              component::range(0.0, 1e9)};
  Numbers kd_{this,
              "Kd",
              {},
              "torque for an error of the velocity",
              "Nm s/rad",
              component::mandatory,
              component::range(0.0, 1e9)};
  Changes changes_{kp_, kd_};
  CheckedGains gains_{
      this,
      [this](const component::Check& check) { return driven_joints(check); },
      [this](const std::vector<DrivenJoint>& joints, double period_s,
             const CheckedGains::Wanted& wanted) { return objection(joints, period_s, wanted); },
      kp_,
      kd_,
      velocity_cutoff()};
  std::optional<control::GravityPd> law_;
};

}  // namespace armature::controllers
