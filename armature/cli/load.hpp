// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/cli/arguments.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::cli {

/// Loads and checks the deployment that a command was given.
inline deploy::Deployment load(const LoadArguments& arguments) {
  deploy::DeploymentOptions options;
  options.document.overrides = arguments.overrides;
  options.library_folders = arguments.library_folders;
  options.mode = arguments.mode;
  options.times_file = arguments.times_file;
  return deploy::load_deployment(arguments.file, options);
}

}  // namespace armature::cli
