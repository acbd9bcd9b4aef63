// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "armature/cli/arguments.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::cli {

/// Loads and checks the deployment that a command was given.
/// @param make_placeholder  for components that live in other processes
inline deploy::Deployment load(const LoadArguments& arguments,
                               deploy::MakePlaceholder make_placeholder) {
  deploy::DeploymentOptions options;
  options.make_placeholder = std::move(make_placeholder);
  options.document.overrides = arguments.overrides;
  options.library_folders = arguments.library_folders;
  options.mode = arguments.mode;
  options.times_file = arguments.times_file;
  return deploy::load_deployment(arguments.file, options);
}

}  // namespace armature::cli
