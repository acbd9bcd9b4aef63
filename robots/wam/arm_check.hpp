// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/dynamics/joint_inertias.hpp"
#include "armature/control/joint_limits.hpp"
#include "armature/controllers/base/checked_gains.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/robot_description.hpp"
#include "robots/wam/torque_path.hpp"
#include "robots/wam/wam_parameters.hpp"

namespace armature::wam {

/// Checks the properties of WamHardware against the arm: limits against its description and motors,
/// the gains with which it holds against its joints, gravity against how it stands; when the
/// deployment is checked, and at each change from then on.
class ArmCheck final : public component::Checked, public component::PropertyFollower {
 public:
  /// [s] from a sample until the torques act that answer it, at most: all pucks' answers, and two
  /// frames of torques.
  static constexpr double kTorqueDelay = 0.0017;

  /// @param joints, bus  properties of `owner`
  ArmCheck(component::Component* owner, const component::Property<int>& joints,
           const component::Property<std::string>& bus,
           const controllers::RobotDescription& description, WamParameters& parameters);

  void check(component::Check& check) const override;

  /// As whoever writes `torRefPort` drives them; nothing if the description cannot be read.
  /// @thread configuration only
  std::vector<controllers::DrivenJoint> driven() const;

  void follow() override {}
  std::string objection() const override { return {}; }
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;

 private:
  /// What the arm is.
  struct Arm {
    std::vector<control::JointRange> ranges;
    std::vector<control::JointLimits> limits;
    std::vector<double> friction;  ///< [N m s/rad] of the motors, at the joints
  };

  const ArmNumbers& numbers() const;
  base::Result<Arm> load() const;
  std::string objection(const controllers::CheckedGains::Wanted& wanted) const;
  std::string objection_to_limits(const TorquePath::Config& config, std::size_t joint) const;
  std::string objection_to_growth(const TorquePath::Config& config, std::size_t joint) const;
  std::string objection_to_hold(const TorquePath::Config& config, std::size_t joint) const;
  std::string objection_to_gravity() const;
  std::vector<controllers::DrivenJoint> driven(const Arm& arm) const;

  component::Component& owner_;
  const component::Property<int>& joints_;
  const component::Property<std::string>& bus_;
  const controllers::RobotDescription& description_;
  WamParameters& parameters_;
  component::Property<bool> other_mounting_;
  mutable std::optional<Arm> arm_;  ///< as the check found it
};

}  // namespace armature::wam
