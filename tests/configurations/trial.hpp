// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/document/document.hpp"
#include "tests/configurations/plant.hpp"

namespace armature::configurations {

enum class Outcome {
  kRefused,     ///< by the check
  kNotStarted,  ///< by a component at the start
  kNotArmed,    ///< nothing moved, and it could not be armed
  kFaulted,     ///< it was stopped in order, within its bounds
  kQuiet,       ///< it did what it was told
  kUnsafe,
};

struct Verdict {
  Outcome outcome = Outcome::kUnsafe;
  std::string why;
};

/// `refused`, `UNSAFE`: for a table.
const char* name_of(Outcome outcome);

/// Has the robot stand unarmed for 3 s while a script calls what it may, armed for 1 s, move, be
/// asked for a motion that cannot be, go over to its other modes, and be stopped in an emergency
/// while it moves; judges it by where it really is.
/// @param folder  for what it writes
Verdict try_out(const RobotUnderTest& robot, const document::Document& document,
                const std::string& folder);

}  // namespace armature::configurations
