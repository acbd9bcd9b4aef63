// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::runner {

/// What a program or a command ends with; the same for all of them.
enum ExitCode {
  kDone = 0,
  kFailed = 1,             ///< the application or its check failed
  kWrongUse = 2,           ///< of the command line
  kNoRealtime = 3,         ///< real time was required and is not to be had
  kStoppedByReaction = 4,  ///< a declared safety reaction ended the run
  kDiffers = 5,            ///< a replay is not what was recorded
  kNotAllCompared = 6      ///< it is, but samples are missing in the recording
};

}  // namespace armature::runner
