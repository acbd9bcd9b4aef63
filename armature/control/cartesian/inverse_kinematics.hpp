// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/control/dynamics/forward_kinematics.hpp"
#include "armature/control/joint_limits.hpp"

namespace armature::control {

/// Where the joints of a robot have to be for a pose of its end, near to where they are: damped
/// least squares (Wampler 1986), so that of a redundant arm no joint moves more than it has to. One
/// thread uses it.
class InverseKinematics {
 public:
  using Config = ForwardKinematics::Config;

  /// As ForwardKinematics::load.
  static std::optional<InverseKinematics> load(const std::string& file, const Config& config,
                                               base::Diagnostics& diagnostics);
  InverseKinematics(InverseKinematics&&) noexcept;
  InverseKinematics& operator=(InverseKinematics&&) noexcept;
  ~InverseKinematics();

  std::size_t joints() const;
  const std::vector<std::string>& joint_names() const;
  const std::vector<JointLimits>& limits() const;

  /// @param positions  of all joints [rad, m]
  Pose pose_at(std::span<const double> positions);
  /// Moves `positions` to where the end has the pose.
  /// @return what is left [m, rad together]: below 1e-8 if it has been reached
  double solve(const Pose& pose, std::span<double> positions);

 private:
  struct Solver;
  explicit InverseKinematics(std::unique_ptr<Solver> solver);

  std::unique_ptr<Solver> solver_;
};

}  // namespace armature::control
