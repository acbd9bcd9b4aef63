// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <kdl/chain.hpp>

#include "armature/base/diagnostic.hpp"
#include "armature/control/joint_limits.hpp"

namespace armature::control::internal {

/// The movable joints of a robot, one behind the other, each with all that moves with it.
struct UrdfChain {
  KDL::Chain segments;              ///< one for each movable joint
  std::vector<std::string> joints;  ///< their names, from the base on
  std::vector<JointLimits> limits;  ///< of the joints, as the description has them
  KDL::Frame tip;                   ///< of the tip link, if one was named, in the last segment
};

/// What part of a description is wanted, and how it is called in diagnostics.
struct UrdfQuery {
  std::string file;
  std::string base_link;  ///< empty: the root
  std::string tip_link;   ///< empty: the only end there is
};

/// The text of a file; nothing, and an error, if it cannot be read.
std::optional<std::string> read_description(const std::string& file,
                                            base::Diagnostics& diagnostics);

/// Reads the description of a robot. What is fixed to a link counts as part of it; a joint beside
/// the way to the tip counts as fixed at 0, with a warning.
/// @return nothing after an error, which names the file, what was expected and what was found
std::optional<UrdfChain> read_urdf(const std::string& text, const UrdfQuery& query,
                                   base::Diagnostics& diagnostics);

}  // namespace armature::control::internal
