// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/controllers/base/robot_description.hpp"
#include "robots/wam/arm_numbers.hpp"
#include "robots/wam/driver/driven_watch.hpp"
#include "robots/wam/driver/float_gate.hpp"
#include "robots/wam/driver/standing_watch.hpp"
#include "robots/wam/driver/wam_motion.hpp"
#include "robots/wam/joint_controller.hpp"
#include "robots/wam/torque_path.hpp"
#include "robots/wam/wam_parameters.hpp"

namespace armature::wam {

/// What limits, watches and holds an arm, as its properties say.
struct ArmParts {
  WamMotion motion;
  TorquePath path;
  StandingWatch standing;
  DrivenWatch driven;
  JointController own_controller;
  FloatGate float_gate;

  /// The error names the property, what was expected and what was found. Shows the gains that count
  /// where none were given.
  /// @param warnings  of the robot's description
  /// @thread configuration only
  static base::Result<ArmParts> make(const ArmNumbers& numbers, WamParameters& parameters,
                                     const controllers::RobotDescription& description,
                                     std::vector<std::string>& warnings);
};

}  // namespace armature::wam
