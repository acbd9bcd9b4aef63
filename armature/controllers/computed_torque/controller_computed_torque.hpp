// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "armature/control/dynamics/computed_torque.hpp"
#include "armature/controllers/base/controller_of_model.hpp"

namespace armature::controllers {

/// Computed torque, by the robot's description and its motors (paper 3, conclusion):
/// control::ComputedTorque, in the place of another Controller. Gains are one number for each
/// joint, or one for all. Where the hardware compensates gravity itself, `gravity` is 0.
/// @rt nonblocking, no allocation, O(joints^2)
class ControllerComputedTorque final : public ControllerOfModel {
 public:
  using ControllerOfModel::ControllerOfModel;

 private:
  base::Result<void> make_law(control::InverseDynamics links) override;
  bool take_change() override { return changes_.take(); }
  void compute(std::span<const double> reference, std::span<const double> motion,
               std::span<double> torques) override;

  base::Result<control::Transmission> motors(const CheckedGains::Wanted& wanted) const;
  std::vector<DrivenJoint> joints_and_model(const component::Check& check);
  std::string objection(const std::vector<DrivenJoint>& joints, double period_s,
                        const CheckedGains::Wanted& wanted) const;
  static std::string objection_to_friction(const DrivenJoint& joint,
                                           const control::Transmission& rotors, std::size_t number);

  using Numbers = component::Property<std::vector<double>>;
  Numbers kp_{this,    "Kp",
              {100.0}, "acceleration for an error: the square of the joint's frequency in rad/s",
              "1/s^2", component::range(0.0, 1e9)};
  Numbers kd_{this,   "Kd",
              {20.0}, "acceleration for an error of the velocity: twice that frequency",
              "1/s",  component::range(0.0, 1e9)};
  Numbers rotor_inertia_{this, "motor_rotor_inertia", {0.0}, "at the motors", "kg m^2"};
  Numbers friction_{this, "motor_viscous_friction", {0.0}, "at the motors", "Nm s/rad"};
  Numbers turns_{this,
                 "motor_turns",
                 {1.0},
                 "turns of a motor for one of a joint: of its own joint, one number for each, or a "
                 "row of all joints for each motor",
                 ""};
  Changes changes_{kp_, kd_, rotor_inertia_, friction_, turns_};
  /// What the model has the joints move, without motors; as the check found it.
  std::vector<control::JointRange> model_;
  std::optional<control::Transmission> checked_motors_;
  CheckedGains gains_{
      this,
      [this](const component::Check& check) { return joints_and_model(check); },
      [this](const std::vector<DrivenJoint>& joints, double period_s,
             const CheckedGains::Wanted& wanted) { return objection(joints, period_s, wanted); },
      kp_,
      kd_,
      rotor_inertia_,
      friction_,
      turns_,
      velocity_cutoff()};
  std::optional<control::ComputedTorque> law_;
};

}  // namespace armature::controllers
