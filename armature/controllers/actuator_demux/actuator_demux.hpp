// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "armature/controllers/base/actuator.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/joint_command.hpp"

namespace armature::controllers {

/// Hands the control signals out to N joints, then raises Act if a Sample came since the last Act,
/// so that all joints apply theirs together (paper 1, section 3.2, ActuatorNDemux).
///
/// A signal that is no finite number is a fault that names the joint, and none is handed out.
/// @rt nonblocking, no allocation, O(joints)
class ActuatorNDemux : public Actuator, public DrivesJoints {
 public:
  /// To joints whose drives are given voltages.
  explicit ActuatorNDemux(std::string name)
      : ActuatorNDemux(std::move(name), JointCommand::kVoltage) {}

  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 protected:
  ActuatorNDemux(std::string name, JointCommand command)
      : Actuator(std::move(name), names_of(command).unit), names_(names_of(command)) {}

 private:
  void actuate(const std::vector<double>& act) override;

  const JointCommandNames& names_;
  component::OutputPorts<double> commands_{
      this, names_.command, joints_, "for each joint", "", component::unit_of(signals_unit_)};
  component::Event<> act_{this, "Act", "all joints apply their commands"};
};

/// To joints whose drives are commanded so.
template <JointCommand kCommand>
class ActuatorNDemuxOf final : public ActuatorNDemux {
 public:
  explicit ActuatorNDemuxOf(std::string name) : ActuatorNDemux(std::move(name), kCommand) {}
};

}  // namespace armature::controllers
