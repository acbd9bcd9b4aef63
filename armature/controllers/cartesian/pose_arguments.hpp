// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/cartesian/pose_path.hpp"

namespace armature::controllers {

/// Poses as people send them: six numbers for each, x y z [m], roll pitch yaw [rad].
base::Result<std::vector<control::Pose>> read_poses_of(const std::vector<double>& numbers);
base::Result<control::Pose> read_pose_of(const std::vector<double>& numbers);

/// In whose axes a tool is jogged.
enum class JogFrame { kBase, kTool };
/// Of "base" or "tool".
base::Result<JogFrame> read_frame_of(std::string_view name);

/// Along or about one axis of a frame.
struct ToolAxis {
  int number = 1;         ///< 1 to 3 along x, y, z; 4 to 6 about them
  double velocity = 0.0;  ///< [m/s or rad/s], not 0; its sign is the direction
  JogFrame frame = JogFrame::kBase;

  bool turns() const { return number > 3; }
};

/// What is wrong with it; empty: nothing.
/// @param most  [m/s or rad/s]
std::string objection_to(const ToolAxis& axis, double most);
/// How fast its line is gone along [m/s], as control::PosePath has it.
double way_of(const ToolAxis& axis);
/// From where the tool is on: 1 m, or 2.5 rad about the tool's own place.
base::Result<control::PosePath> line_along(const control::Pose& from, const ToolAxis& axis);
/// Of a line that is followed to its end.
std::string_view longest_text(const ToolAxis& axis);

}  // namespace armature::controllers
