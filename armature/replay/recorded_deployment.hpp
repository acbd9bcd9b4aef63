// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/replay/experiment.hpp"

namespace armature::replay {

/// What an experiment is to have of its own this time.
struct Changes {
  std::vector<std::string> overrides;  ///< as `--set` has them
  std::string
      file;  ///< a deployment whose sections win over those of the recorded one; empty: none
  bool any() const { return !overrides.empty() || !file.empty(); }
};

/// Writes what is changed as JSON, for the report's page.
/// @param only  components that ran again without the others; empty: all did
base::Result<void> write_changes(const std::string& path, const Changes& changes,
                                 const std::set<std::string>& only);

/// Loads the deployment of an experiment from the texts that the run has left, with the component
/// libraries that are there now. What differs from then, though nobody asked for it, is a warning:
/// a library, a file that a property names, a property.
/// @param out  folder for files that are not there any more as they were
deploy::Deployment load_recorded(const Experiment& experiment, const Changes& changes,
                                 const std::string& out, const deploy::DeploymentOptions& options);

/// How a run was asked for.
struct Ran {
  std::string version;  ///< of Armature
  bool simulated = false;
  std::vector<std::string> overrides;
  std::string mode;
  std::vector<std::string> library_folders;
};

/// What a run is to leave of itself.
/// @param texts  as `deploy::LoadOptions::seen` was told them
Experiment experiment_of(const deploy::Deployment& deployment,
                         std::map<std::string, std::string> texts, const Ran& how);

}  // namespace armature::replay
