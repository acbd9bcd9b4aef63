// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/component/face.hpp"
#include "armature/control/dc_motor.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/controller_of_pids.hpp"

namespace armature::controllers {

/// An independent PID for each joint and feed-forward of the robot's dynamics along the desired
/// motion (paper 1, section 3.4, ControllerNPIDFF):
///
///     act_i = PID_i + voltage_i(model torque_i + reflected inertia_i qdd_i, qd_i)
///
/// with the voltage of control::DcMotor, and qd, qdd as desired. In_model has the reference; the
/// Model answers on Out_model. The model is one that has to answer in each round, like a PID; if it
/// does not, its last torques stand for the new ones. UMin and UMax are limits of the PIDs; the sum
/// is limited by the joint. Parameters of the motors are one number for each joint, or one for all.
/// @rt nonblocking, no allocation, O(joints)
class ControllerNPIDFF final : public ControllerOfPids {
 public:
  using ControllerOfPids::ControllerOfPids;

  /// Of the torques of its model: all joints.
  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override {
    if (input == &face(out_model_)) return driven_joints(check);
    return ControllerOfPids::joints_behind(input, check);
  }

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  std::size_t others() const override { return 1; }
  std::string_view name_of_other(std::size_t member) const override;
  void ask_others(const std::vector<double>& reference) override;
  void conclude(const std::vector<double>& answers) override;
  std::optional<std::array<double, 3>> gravity_held(const component::Check& check) const override;

  component::Outcome set_up_motors();
  base::Result<std::vector<control::DcMotor>> make_motors(const CheckedGains::Wanted& wanted) const;
  std::string objection(const std::vector<DrivenJoint>& joints,
                        const CheckedGains::Wanted& wanted) const;
  void on_torques(const std::vector<double>& torques);

  using Numbers = component::Property<std::vector<double>>;
  Numbers resistance_{this,  "motor_resistance",  {}, "of the winding, > 0",
                      "Ohm", component::mandatory};
  Numbers torque_constant_{this,   "motor_torque_constant",
                           {},     "of the motor, also of its back-EMF; > 0",
                           "Nm/A", component::mandatory};
  Numbers gear_ratio_{this, "motor_gear_ratio",  {}, "turns of the motor for one of the joint, > 0",
                      "",   component::mandatory};
  Numbers rotor_inertia_{this, "motor_rotor_inertia", {0.0}, "at the motor", "kg m^2"};
  Numbers viscous_friction_{this, "viscous_friction", {0.0}, "at the joint", "Nm s/rad"};
  Numbers coulomb_friction_{this, "coulomb_friction", {0.0}, "at the joint", "Nm"};
  Numbers coulomb_velocity_{this,
                            "coulomb_velocity",
                            {0.0},
                            "below it Coulomb friction falls linearly to 0; 0: the plain sign",
                            "rad/s"};
  component::InputPort<std::vector<double>> out_model_{
      this,
      "Out_model",
      "torques that move the links as desired [tau1..tauN]",
      "Nm",
      component::on_data<&ControllerNPIDFF::on_torques>,
      component::size_of(joints_),
      component::leads_to("act")};
  component::OutputPort<std::vector<double>> in_model_{
      this, "In_model", "desired [q1..qN, qd1..qdN, qdd1..qddN]: rad, rad/s, rad/s^2", "",
      component::size_of(joints_, 3)};
  Changes changes_{joints_,        resistance_,       torque_constant_,  gear_ratio_,
                   rotor_inertia_, viscous_friction_, coulomb_friction_, coulomb_velocity_};

  CheckedGains checked_{
      this,
      [this](const component::Check& check) { return driven_joints(check); },
      [this](const std::vector<DrivenJoint>& joints, double /*period_s*/,
             const CheckedGains::Wanted& wanted) { return objection(joints, wanted); },
      resistance_,
      torque_constant_,
      gear_ratio_,
      rotor_inertia_,
      viscous_friction_,
      coulomb_friction_};
  std::vector<control::DcMotor> motors_;
  std::vector<double> desired_;  ///< reference of this round
  std::vector<double> torques_;  ///< that the model answered last
  std::vector<double> signals_;
};

}  // namespace armature::controllers
