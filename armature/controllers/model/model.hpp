// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/robot_description.hpp"

namespace armature::controllers {

/// The inverse dynamics of the robot (paper 1, equation 1 and section 3.4.1, Model): Out has the
/// torques that move its links as In says, from its description file (URDF) by
/// control::InverseDynamics. Actuators, with their rotors and friction, are not in it.
///
/// Refuses to be configured if the file cannot be read, is no URDF, or has another number of
/// movable joints than `joints`; the check refuses a gravity in another direction than that of the
/// joints that it drives. A motion that is not finite is a fault, and nothing is written.
/// @rt nonblocking, no allocation, O(joints)
class Model final : public component::Component, public ComputesTorques {
 public:
  using Component::Component;

  const std::array<double, 3>& gravity() const override { return description_.gravity(); }

 private:
  component::Outcome on_configure() override;
  void on_check(component::Check& check) const override;
  void compute(const std::vector<double>& motion);

  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  RobotDescription description_{this};
  component::InputPort<std::vector<double>> in_{
      this,
      "In",
      "motion [q1..qN, qd1..qdN, qdd1..qddN]: rad, rad/s, rad/s^2",
      "",
      component::on_data<&Model::compute>,
      component::size_of(joints_, 3),
      component::max_age(kMaxAge)};
  component::OutputPort<std::vector<double>> out_{this, "Out", "torques [tau1..tauN]", "Nm",
                                                  component::size_of(joints_)};

  std::optional<control::InverseDynamics> dynamics_;
  std::vector<double> torques_;
};

}  // namespace armature::controllers
