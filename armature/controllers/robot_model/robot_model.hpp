// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/dynamics/joint_inertias.hpp"
#include "armature/control/joint_limits.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/robot_description.hpp"

namespace armature::controllers {

/// What a robot weighs and what its drives do: for the check of gains and limits, which finds it as
/// a peer of each Joint. It does nothing while the robot runs.
///
/// Links are those of the description (URDF), or, without one, `inertia_min` and `inertia_max` say
/// what each joint moves. Joints that are given voltages need `motor_resistance` and
/// `motor_torque_constant` of DC motors behind gears, those that are given currents the latter;
/// with neither, efforts are torques at the joints. Vectors have one number for each joint, or one
/// for all.
class RobotModel final : public component::Component, public DescribesRobot {
 public:
  using Component::Component;

  base::Result<DrivenJoint> joint(std::size_t number, JointCommand command) const override;
  control::JointLimits limits(std::size_t number) const override;

 private:
  void on_check(component::Check& check) const override;

  /// The motor of one joint; 0: not told.
  struct Motor {
    double torque_per_ampere = 0.0;  ///< at the joint
    double resistance = 0.0;
  };
  /// What properties make of it.
  struct Robot {
    std::vector<DrivenJoint> joints;  ///< behind torques
    std::vector<Motor> motors;
    std::vector<control::JointLimits> limits;
  };
  const base::Result<Robot>& robot() const;
  base::Result<Robot> make() const;
  base::Result<std::vector<control::JointRange>> ranges(Robot& robot) const;
  base::Result<void> add_drives(Robot& robot) const;

  std::size_t joints() const { return static_cast<std::size_t>(joints_.get()); }

  using Numbers = component::Property<std::vector<double>>;
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  RobotDescription description_{this, RobotDescription::Need::kOptional};
  Numbers inertia_min_{
      this, "inertia_min", {}, "without a description: the least that a joint moves", "kg m^2"};
  Numbers inertia_max_{
      this, "inertia_max", {}, "without a description: the most that a joint moves", "kg m^2"};
  Numbers weight_{
      this, "weight", {0.0}, "without a description: the most that a joint holds", "Nm"};
  Numbers resistance_{this,
                      "motor_resistance",
                      {},
                      "of the winding; none: its joints are given no voltages",
                      "Ohm"};
  Numbers torque_constant_{
      this, "motor_torque_constant", {}, "of the motor, also of its back-EMF", "Nm/A"};
  Numbers gear_ratio_{
      this, "motor_gear_ratio", {1.0}, "turns of the motor for one of the joint", ""};
  Numbers rotor_inertia_{this, "motor_rotor_inertia", {0.0}, "at the motor", "kg m^2"};
  Numbers friction_{this, "viscous_friction", {0.0}, "at the joint", "Nm s/rad"};
  Numbers delay_{this,  "effort_delay",
                 {0.0}, "from a sample until the effort acts that answers it",
                 "s",   component::range(0.0, 10.0)};
  mutable std::optional<base::Result<Robot>> robot_;  ///< as the properties were last
  mutable Changes changes_{joints_,          inertia_min_, inertia_max_,   weight_,   resistance_,
                           torque_constant_, gear_ratio_,  rotor_inertia_, friction_, delay_};
};

}  // namespace armature::controllers
