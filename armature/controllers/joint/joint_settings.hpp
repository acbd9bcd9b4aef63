// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "armature/component/author.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/joint_command.hpp"

namespace armature::controllers {

/// Where a joint counts its position from: with another one it is elsewhere.
struct JointZero {
  double position = 0.0;  ///< InitialPos
  double sensor_sign = 1.0;
  double gear_ratio = 1.0;
  double sensor_range = 0.0;

  bool operator==(const JointZero&) const = default;
};

/// What a Joint is told of itself. Positions of the joint, in its unit (rad or m); efforts in the
/// unit of its command.
struct JointSettings {
  // Of the hardware; paper 1, section 3.1.
  double actuator_sign = 1.0;
  double sensor_sign = 1.0;
  double gear_ratio = 1.0;
  double initial_position = 0.0;
  double sensor_range = 0.0;  ///< of PositionSensor

  // Of the limiter.
  bool continuous = false;
  double lower = 0.0;
  double upper = 0.0;
  double max_velocity = 0.0;
  double max_acceleration = 0.0;
  double max_effort = 0.0;  ///< of a joint that is commanded by an effort
  double max_error = 0.0;   ///< of one whose drive follows velocities or positions

  // Of arming.
  double arming_time = 1.0;
  double arming_motion = 0.01;

  // Of homing.
  bool homing_required = false;
  double homing_time = 60.0;

  // Of the watch over the joint while it is to stand.
  double holding_motion = 0.1;
  double holding_velocity = 0.5;
  double holding_alternation = 0.4;

  JointZero zero() const { return {initial_position, sensor_sign, gear_ratio, sensor_range}; }
  /// Where the joint ends; a continuous one does not.
  double lowest() const { return continuous ? -std::numeric_limits<double>::infinity() : lower; }
  double highest() const { return continuous ? std::numeric_limits<double>::infinity() : upper; }
};

/// What a Joint's numbers are in: those of `Unit`, which is rad, or m of a linear axis. The motor
/// behind it turns in both cases: GearRatio tells by how much the joint moves for it.
class JointUnits {
 public:
  JointUnits(component::Component* owner, JointCommand command)
      : axis_(owner, AxisUnit::Of::kOneAxis),
        command_(
            owner, {&axis_.position()},
            [this, command] { return unit_for(names_of(command).unit, axis_.position().get()); }),
        gear_(owner, {&axis_.position()},
              [this] { return axis_.position().get() == "m" ? "m/rad" : ""; }),
        homing_effort_(owner, {&axis_.position()},
                       [this, command] {
                         return unit_for(is_effort(command) ? names_of(command).unit : "Nm",
                                         axis_.position().get());
                       }),
        stiffness_(owner, {&axis_.position()},
                   [this] { return gain_unit(homing_effort_.get(), axis_.position().get()); }),
        damping_(owner, {&axis_.position()},
                 [this] { return gain_unit(homing_effort_.get(), axis_.position().get(), "s"); }) {}

  const AxisUnit& position() const { return axis_.position(); }
  const DerivedUnit& velocity() const { return axis_.velocity(); }
  const DerivedUnit& acceleration() const { return axis_.acceleration(); }
  const DerivedUnit& command() const { return command_; }
  const DerivedUnit& gear() const { return gear_; }
  /// Of what homes it: as it is commanded, or of a drive that follows by itself at the joint.
  const DerivedUnit& homing_effort() const { return homing_effort_; }
  const DerivedUnit& stiffness() const { return stiffness_; }
  const DerivedUnit& damping() const { return damping_; }

 private:
  AxisUnits axis_;
  DerivedUnit command_;
  DerivedUnit gear_;
  DerivedUnit homing_effort_;
  DerivedUnit stiffness_;
  DerivedUnit damping_;
};

/// They are the properties of a Joint.
class JointProperties final : public component::Properties<JointSettings> {
 public:
  /// @param units  of the joint; outlive this
  JointProperties(component::Component* owner, JointCommand command, const JointUnits& units);

  const JointUnits& units() const { return units_; }

 private:
  const JointUnits& units_;
};

}  // namespace armature::controllers
