// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// Between the vectors of a generator of motions and those of a controller (paper 1, table 1,
/// BridgeRef; paper 2, section 5.3): hands the positions of `sensor` on, and composes `reference`
/// of desired positions, velocities and accelerations, once all three of a step have come, in
/// whatever order. What is desired has no age here: who follows `reference` looks at that.
/// @rt nonblocking, no allocation, O(joints)
class BridgeRef final : public component::Component, public DrivesJoints {
 public:
  using Component::Component;

  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_sensor(const std::vector<double>& sensor);
  void on_position(const std::vector<double>& desired) { take(kPosition, desired); }
  void on_velocity(const std::vector<double>& desired) { take(kVelocity, desired); }
  void on_acceleration(const std::vector<double>& desired) { take(kAcceleration, desired); }

  enum Part : std::size_t { kPosition, kVelocity, kAcceleration, kParts };
  void take(Part part, const std::vector<double>& desired);

  using Vector = std::vector<double>;
  AxisUnits units_{this, AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::InputPort<Vector> sensor_{this,
                                       "sensor",
                                       "measured [q1..qN, d1..dN]: positions, then displacements",
                                       "",
                                       component::on_data<&BridgeRef::on_sensor>,
                                       component::size_of(joints_, 2),
                                       component::max_age(kMaxAge),
                                       component::leads_to("nAxesSensorPosition"),
                                       component::unit_of(units_.position())};
  component::InputPort<Vector> position_{this,
                                         "nAxesDesiredPosition",
                                         "desired position of each joint",
                                         "",
                                         component::on_data<&BridgeRef::on_position>,
                                         component::size_of(joints_),
                                         component::leads_to("reference"),
                                         component::unit_of(units_.position())};
  component::InputPort<Vector> velocity_{this,
                                         "nAxesDesiredVelocity",
                                         "desired velocity of each joint",
                                         "",
                                         component::on_data<&BridgeRef::on_velocity>,
                                         component::size_of(joints_),
                                         component::leads_to("reference"),
                                         component::unit_of(units_.velocity())};
  component::InputPort<Vector> acceleration_{this,
                                             "nAxesDesiredAcceleration",
                                             "desired acceleration of each joint",
                                             "",
                                             component::on_data<&BridgeRef::on_acceleration>,
                                             component::size_of(joints_),
                                             component::leads_to("reference"),
                                             component::unit_of(units_.acceleration())};
  component::OutputPort<Vector> sensor_position_{
      this, "nAxesSensorPosition",       "measured position of each joint",
      "",   component::size_of(joints_), component::unit_of(units_.position())};
  component::OutputPort<Vector> reference_{
      this, "reference", "desired [q1..qN, qd1..qdN, qdd1..qddN]: rad, rad/s, rad/s^2", "",
      component::size_of(joints_, 3)};

  Vector positions_;
  Vector composed_;
  bool arrived_[kParts] = {};
};

}  // namespace armature::controllers
