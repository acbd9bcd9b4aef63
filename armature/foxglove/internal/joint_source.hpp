// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/inspect/describe.hpp"

namespace armature::foxglove::internal {

/// Where the positions of a robot's joints come from.
struct JointSource {
  std::string port;                ///< `Sensor.Positions`, `Joint{1..7}.Position`
  std::vector<std::string> items;  ///< one with the numbers of all joints first, or one for each

  double score = 0.0;  ///< how much it looks like measured positions
};

/// As the studio's page finds it (web/studio/src/robots.ts): by names, docs and units of ports.
/// @param owner   the component that names the robot's description
/// @param chosen  a port that the user has chosen; empty: none
/// @return the error says why there is none
base::Result<JointSource> joint_source(const std::vector<inspect::ComponentDescription>& components,
                                       const std::string& owner, std::size_t joints,
                                       const std::string& chosen);

}  // namespace armature::foxglove::internal
