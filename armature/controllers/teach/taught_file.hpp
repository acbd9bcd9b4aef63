// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/taught/taught_motion.hpp"

namespace armature::controllers {

/// The text of a taught motion: who reads it sees what was measured, a line for each sample.
///
///     # A taught motion: of each sample the time [s] and the positions [rad] of the joints.
///     motion: wave
///     joints: 3
///     samples: 2
///     0.000: [0, 0.5, -1.2]
///     0.010: [0, 0.501, -1.2]
std::string to_motion_text(std::string_view name, const control::TaughtSamples& samples);

/// Reads it back. The error begins with the line, "line 7: ...", and says what was expected; a file
/// that was cut off, or has more than it says, is one.
/// @param joints  that the motion must have
base::Result<control::TaughtSamples> read_motion_text(std::string_view text, std::size_t joints);

/// Named poses of all joints [rad], by their names.
using Poses = std::map<std::string, std::vector<double>>;

/// The text of a file of poses, a pose a line: `home: [0, -114.6, 0] deg`.
/// @param unit  in which it is written: rad or deg (m or mm for linear axes)
std::string to_pose_text(const Poses& poses, std::string_view unit);

/// Reads it back: empty lines and `#` to the end of a line say nothing; each line may have another
/// unit, and has to have one. Errors as above, all of them, a line each.
base::Result<Poses> read_pose_text(std::string_view text, std::size_t joints);

/// Whether it may be the name of a motion or pose: letters, digits, `_` and `-`, at most 63.
bool is_taught_name(std::string_view name);

}  // namespace armature::controllers
