// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "armature/controllers/base/actuator.hpp"
#include "armature/controllers/base/driven_joint.hpp"

namespace armature::wam {

/// The actuators of the arm (paper 3, ActuatorWAM): hands the torques of all joints on to
/// WamHardware, once for each Sample (paper 1, section 3); torques without a Sample are counted and
/// go no further. One that is no finite number is a fault, and nothing is handed on.
/// @rt nonblocking, no allocation, O(joints)
class ActuatorWam final : public controllers::Actuator, public controllers::DrivesJoints {
 public:
  explicit ActuatorWam(std::string name) : Actuator(std::move(name), "Nm") {}

  std::vector<controllers::DrivenJoint> joints_behind(const component::InputPortBase* input,
                                                      const component::Check& check) override;

 private:
  void actuate(const std::vector<double>& act) override;

  component::Outcome on_start() override {
    unsampled_.assign(0);
    return Actuator::on_start();
  }

  component::Attribute<int> unsampled_{
      this, "act_without_sample", 0,
      "values of `act` since the start that came without a Sample: nothing was handed on"};
  component::OutputPort<std::vector<double>> torque_{this, "Torque", "of the joints", "Nm",
                                                     component::size_of(joints_)};
};

}  // namespace armature::wam
