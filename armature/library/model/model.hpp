// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/author.hpp"
#include "armature/control/inverse_dynamics.hpp"
#include "armature/library/base/max_age.hpp"

namespace armature::library {

/// The inverse dynamics of the robot (paper 1, equation 1 and section 3.4.1, Model): Out has the
/// torques that move its links as In says, from its description file (URDF) by
/// control::InverseDynamics. Actuators, with their rotors and friction, are not in it.
///
/// Refuses to be configured if the file cannot be read, is no URDF, or has another number of
/// movable joints than `joints`. A motion that is not finite is a fault, and nothing is written.
/// @rt nonblocking, no allocation, O(joints)
class Model final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override;
  void compute(const std::vector<double>& motion);
  component::Outcome tell(const base::Diagnostics& diagnostics);
  component::Outcome check_joints() const;

  component::Property<int> joints_{
      this, "joints", 1, "how many", "", component::mandatory, component::range(1, 100000)};
  component::Property<std::string> description_{
      this, "robot_description",
      "",   "the robot's description (URDF), a file; a path counts from the working directory",
      "",   component::mandatory};
  component::Property<std::string> base_link_{this, "base_link", "",
                                              "the link that stands still; empty: the root"};
  component::Property<std::string> tip_link_{
      this, "tip_link", "", "the end of the chain of joints; empty: the only end there is"};
  component::Property<std::array<double, 3>> gravity_{
      this, "gravity", {0.0, 0.0, -9.81}, "in the axes of the base link", "m/s^2"};
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

}  // namespace armature::library
