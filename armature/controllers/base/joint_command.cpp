// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/joint_command.hpp"

#include <array>
#include <cstddef>

namespace armature::controllers {
namespace {

constexpr std::string_view kMost = "the most that is applied";
constexpr std::array<JointCommandNames, 5> kNames{{
    {"Voltage", "VoltageActuator", "V", "MaxVoltage", kMost},
    {"Current", "CurrentActuator", "A", "MaxCurrent", kMost},
    {"Torque", "TorqueActuator", "Nm", "MaxTorque", "the most that is applied, at the joint"},
    {"DesiredVelocity", "VelocityActuator", "rad/s", "MaxVelocityError",
     "a joint whose velocity differs more from what its drive is told, for 0.1 s, is braked, and "
     "faults"},
    {"DesiredPosition", "PositionActuator", "rad", "MaxPositionError",
     "a joint that is farther from where its drive is told to be is braked, and faults"},
}};

}  // namespace

const JointCommandNames& names_of(JointCommand command) {
  return kNames[static_cast<std::size_t>(command)];
}

}  // namespace armature::controllers
