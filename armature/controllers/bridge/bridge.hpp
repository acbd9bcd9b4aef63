// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// Between a generator's vectors and joints that each have a controller of their own (paper 2,
/// section 5.3): makes one vector of the measured positions, written with each that comes once all
/// have come, and hands out the desired ones.
/// @rt nonblocking, no allocation, O(joints)
class Bridge final : public component::Component, public DrivesJoints {
 public:
  using Component::Component;

  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_position(std::size_t joint, double position);
  void on_desired(const std::vector<double>& desired);

  using Vector = std::vector<double>;
  AxisUnits units_{this, AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::InputPorts<double> position_{this,
                                          "Position",
                                          joints_,
                                          "measured position of each joint",
                                          "",
                                          component::on_data<&Bridge::on_position>,
                                          component::leads_to("nAxesSensorPosition"),
                                          component::unit_of(units_.position())};
  component::InputPort<Vector> desired_{this,
                                        "nAxesDesiredPosition",
                                        "desired position of each joint",
                                        "",
                                        component::on_data<&Bridge::on_desired>,
                                        component::size_of(joints_),
                                        component::max_age(kMaxAge),
                                        component::leads_to("Ref"),
                                        component::unit_of(units_.position())};
  component::OutputPort<Vector> positions_{
      this, "nAxesSensorPosition",       "measured position of each joint",
      "",   component::size_of(joints_), component::unit_of(units_.position())};
  component::OutputPorts<double> ref_{this,    "Ref",
                                      joints_, "desired position of each joint",
                                      "",      component::unit_of(units_.position())};

  Vector measured_;
  std::vector<bool> came_;  ///< since the start
  std::size_t missing_ = 0;
};

}  // namespace armature::controllers
