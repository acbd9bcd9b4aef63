// SPDX-License-Identifier: Apache-2.0
// The arm of examples/11_drives with drives whose encoders begin anywhere, as tests of homing have
// it.
#pragma once

#include <string>
#include <vector>

#include "armature/deploy/deployment.hpp"

namespace armature::testing {

inline std::vector<std::string> effort_settings(const std::string& way) {
  if (way == "voltage") {
    return {"Joint1.HomingEffort=3 V", "Joint1.HomingStiffness=150", "Joint1.HomingDamping=4"};
  }
  if (way == "torque") {
    return {"Joint1.HomingEffort=6 Nm", "Joint1.HomingStiffness=300", "Joint1.HomingDamping=14"};
  }
  return {};
}

/// @param way  `voltage`, `torque`, `velocity` or `position`
inline deploy::Deployment load_arm(const std::string& way,
                                   const std::vector<std::string>& settings) {
  deploy::DeploymentOptions options;
  options.library_folders = {ROBOT_LIBRARY, EXAMPLE_LIBRARY};
  options.document.overrides = {"drive=CountingDrive", "Drive1.Begin=-0.4"};
  for (const std::string& each : settings) options.document.overrides.push_back(each);
  return deploy::load_deployment(EXAMPLES "/11_drives/" + way + ".yaml", options);
}

/// Of its first joint, which stands at -0.4 rad and looks for home backwards.
inline std::vector<std::string> settings_of(const std::string& way, const std::string& method) {
  std::vector<std::string> all = effort_settings(way);
  all.insert(all.end(), {"Joint1.HomingMethod=" + method, "Joint1.HomingVelocity=-0.2",
                         "Joint1.HomingTravel=1.3 rad", "Joint1.HomingRequired=true"});
  if (method == "hard_stop" && all.size() == 4) all.emplace_back("Joint1.HomingEffort=6 Nm");
  return all;
}

}  // namespace armature::testing
