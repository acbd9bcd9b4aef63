// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/joint_settings.hpp"

namespace armature::controllers {

using component::mandatory;
using component::member;
using component::range;
using component::sign;
using component::unit_of;

JointProperties::JointProperties(component::Component* owner, JointCommand command,
                                 const JointUnits& units)
    : Properties(
          owner, {},
          member(&JointSettings::actuator_sign, "ActuatorSign",
                 "-1, or true, if a positive command moves the joint backwards", "", sign),
          member(&JointSettings::sensor_sign, "SensorSign",
                 "-1, or true, if the sensor counts backwards", "", sign),
          member(&JointSettings::gear_ratio, "GearRatio",
                 "motion of the joint per motion of its sensor", "", mandatory,
                 unit_of(units.gear())),
          member(&JointSettings::initial_position, "InitialPos",
                 "where the joint is at the first start; with PositionSensor: where that says 0",
                 "", unit_of(units.position())),
          member(&JointSettings::sensor_range, "SensorRange",
                 "after which PositionSensor begins again, such as 360 deg; 0: it counts turns",
                 "rad", range(0.0, 1e9)),
          member(&JointSettings::continuous, "Continuous",
                 "it turns without end, as a wheel does, and has no PositionMin and PositionMax"),
          member(&JointSettings::lower, "PositionMin",
                 "nothing drives the joint beyond; must be given unless Continuous", "",
                 unit_of(units.position())),
          member(&JointSettings::upper, "PositionMax",
                 "nothing drives the joint beyond; must be given unless Continuous", "",
                 unit_of(units.position())),
          member(&JointSettings::max_velocity, "MaxVelocity", "nothing drives it on at more", "",
                 mandatory, unit_of(units.velocity())),
          member(&JointSettings::max_acceleration, "MaxAcceleration",
                 "with which it can brake, before its limits, too", "", mandatory,
                 unit_of(units.acceleration())),
          member(is_effort(command) ? &JointSettings::max_effort : &JointSettings::max_error,
                 names_of(command).limit, names_of(command).limit_doc, "", mandatory,
                 unit_of(units.command())),
          member(&JointSettings::arming_time, "ArmingTime",
                 "for which the effort may only grow slowly after arming", "s", range(0.0, 60.0)),
          member(&JointSettings::arming_motion, "ArmingMotion",
                 "a joint that moves more when it is armed is braked again, and not armed", "",
                 range(1e-6, 1.0), unit_of(units.position())),
          member(&JointSettings::homing_required, "HomingRequired",
                 "it is not armed before it has homed since its start"),
          member(&JointSettings::homing_time, "HomingTime", "the longest that homing may take", "s",
                 range(0.01, 3600.0)),
          member(&JointSettings::holding_motion, "HoldingMotion",
                 "a joint that is to stand and moves farther is braked, and faults", "",
                 range(1e-6, 1e3), unit_of(units.position())),
          member(&JointSettings::holding_velocity, "HoldingVelocity",
                 "a joint that is to stand and is faster in three samples is braked, and faults",
                 "", range(1e-6, 1e3), unit_of(units.velocity())),
          member(&JointSettings::holding_alternation, "HoldingAlternation",
                 "largest share of samples in which the effort that holds it changes its sign; 1: "
                 "any",
                 "", range(0.01, 1.0))),
      units_(units) {}

}  // namespace armature::controllers
