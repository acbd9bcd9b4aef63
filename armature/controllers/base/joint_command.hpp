// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace armature::controllers {

/// How the drive of a joint is commanded.
enum class JointCommand : std::uint8_t { kVoltage, kCurrent, kTorque, kVelocity, kPosition };

/// What its ports and limits are called; all of them literals.
struct JointCommandNames {
  std::string_view command;   ///< input of the joint, and output of what hands commands out
  std::string_view actuator;  ///< output of the joint, and input of the hardware
  std::string_view unit;
  std::string_view limit;      ///< property of the joint
  std::string_view limit_doc;  ///< and its documentation
};

const JointCommandNames& names_of(JointCommand command);

/// A voltage, current or torque: what moves the joint is up to who controls it. Velocities and
/// positions are followed by the drive.
constexpr bool is_effort(JointCommand command) { return command <= JointCommand::kTorque; }

}  // namespace armature::controllers
