// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"

namespace armature::bundle::internal {

/// The deployment whose files are looked for.
struct DeploymentSource {
  std::string file;                    ///< absolute
  std::vector<std::string> overrides;  ///< as `LoadOptions` has them
  std::string script;                  ///< absolute; empty: none
};

/// What a deployment refers to, by absolute paths without `.` and `..`.
struct DeploymentFiles {
  std::map<std::string, base::Location> files;  ///< all that is to be read, and who names it
  std::set<std::string> libraries;  ///< component libraries among them, which were named by a path
  std::set<std::string> keys;       ///< private keys, which are not among them
  std::set<std::string> saved;      ///< property files that a run writes when it stops
};

/// Finds what the deployment refers to: what it includes, property files, interfaces with their
/// imports, files that properties name (of a robot's description its meshes, too), policy,
/// certificates, pages, libraries by a path, and the script with the modules that it requires.
/// Tells of what would not be found in another place: absolute paths are errors; what counts from
/// the working directory is a warning.
/// @param source  of a deployment that has been checked
DeploymentFiles find_files(const DeploymentSource& source, base::Diagnostics& diagnostics);

}  // namespace armature::bundle::internal
