// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/control/dynamics/forward_kinematics.hpp"

namespace armature::control {

/// A pose as people write it: x, y, z [m], then roll, pitch, yaw [rad] as URDF has them, the turn
/// about the fixed axes x, y, z one after the other.
using PoseNumbers = std::array<double, 6>;
Pose pose_of(const PoseNumbers& numbers);
PoseNumbers numbers_of(const Pose& pose);

/// What two poses are apart [m], and by which angle [rad].
struct PoseDistance {
  double way = 0.0;
  double angle = 0.0;
};
PoseDistance distance(const Pose& left, const Pose& right);

/// The way of a tool: lines, arcs, and lines with rounded corners. Its orientation changes evenly
/// with the way of each part. The first derivative by the way is continuous.
class PosePath {
 public:
  static base::Result<PosePath> line(const Pose& from, const Pose& to);
  /// On the circle through three places; the orientation goes from that of the first to that of the
  /// last the shorter way round.
  static base::Result<PosePath> arc(const Pose& from, const std::array<double, 3>& via,
                                    const Pose& to);
  /// On lines through `poses`, all but the last of which are passed by on a parabola that begins
  /// and ends `blend` before and behind it, at most half of the lines there.
  /// @param blend  [m], above 0 if there is a corner
  /// @return the error names the pose, from 1, that is where the one before is, or at which the
  ///         path turns back by more than 170 degrees: no curve leads round it
  static base::Result<PosePath> through(const Pose& from, std::span<const Pose> poses,
                                        double blend);

  /// [m], above 0; where a part turns the tool more than it moves it, 0.1 m for each rad.
  double length() const { return length_; }
  /// @param way  [m] from the begin on; outside: the nearest end
  Pose at(double way) const;
  /// How much the path bends between two ways [1/m]: the tool's acceleration across it, at 1 m/s,
  /// and that of its turn, 0.1 m for each rad. An upper bound: the most of the parts there.
  double bend(double from, double to) const;

  class Part;

 private:
  explicit PosePath(std::vector<std::shared_ptr<const Part>> parts);

  std::vector<std::shared_ptr<const Part>> parts_;
  double length_ = 0.0;
};

}  // namespace armature::control
