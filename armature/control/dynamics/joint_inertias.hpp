// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/control/transmission.hpp"

namespace armature::control {

/// What a joint has to move in the poses of its robot [kg m^2], with the rotors, and what it has to
/// hold there.
struct JointRange {
  double least_inertia = 0.0;           ///< with all other joints free to give way
  double most_inertia = 0.0;            ///< with all others held
  double most_weight = 0.0;             ///< [N m]
  std::vector<double> lightest_pose{};  ///< where it has the least inertia [rad]
  std::vector<double> heaviest_pose{};  ///< where it has the most
};

/// Between which positions a joint is looked at: those of its description, a whole turn where it
/// has none.
struct SearchedPoses {
  std::vector<double> lower;
  std::vector<double> upper;
};
SearchedPoses search_limits(const InverseDynamics& links);

/// Searches poses for the largest and smallest of them, the same
/// ones every time: by poses that are spread evenly, and from the best of them joint by joint.
/// @param rotors  that turn with the joints; none: only the links
/// @return one for each joint
/// @thread configuration only: milliseconds
std::vector<JointRange> find_joint_ranges(InverseDynamics& links, const Transmission* rotors,
                                          const SearchedPoses& poses);

}  // namespace armature::control
