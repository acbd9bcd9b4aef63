// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/controllers/base/actuator.hpp"
#include "armature/controllers/base/driven_joint.hpp"

namespace armature::controllers {

/// Hands the control signals out to N joints, then raises Act if a Sample came since the last Act,
/// so that all joints apply theirs together (paper 1, section 3.2, ActuatorNDemux).
///
/// A signal that is no finite number is a fault that names the joint, and none is handed out.
/// @rt nonblocking, no allocation, O(joints)
class ActuatorNDemux final : public Actuator, public DrivesJoints {
 public:
  using Actuator::Actuator;

  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 private:
  void actuate(const std::vector<double>& act) override;

  component::OutputPorts<double> voltage_{this, "Voltage", joints_, "for each joint", "V"};
  component::Event<> act_{this, "Act", "all joints apply their voltages"};
};

}  // namespace armature::controllers
