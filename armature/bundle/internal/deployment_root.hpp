// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/bundle/internal/deployment_files.hpp"

namespace armature::bundle::internal {

/// The folder that becomes `deployment/` in a bundle: the deepest one that has all files of the
/// deployment, and the places of those that do not travel with it. Refuses files of the system, and
/// files that have nothing but `/` in common.
/// @return with a slash at its end; empty after an error
std::string deployment_root(const DeploymentFiles& files, base::Diagnostics& diagnostics);

}  // namespace armature::bundle::internal
