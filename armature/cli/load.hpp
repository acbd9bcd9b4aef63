// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "armature/cli/arguments.hpp"
#include "armature/cli/network.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/remote/interface_file.hpp"

namespace armature::cli {

/// Loads and checks the deployment that a command was given.
/// @param network  for what lives in other processes, or is open to them
/// @param read     of its files; empty: from disk
inline deploy::Deployment load(const LoadArguments& arguments, NetworkOnDemand& network,
                               deploy::FileReader read = {}) {
  deploy::DeploymentOptions options;
  options.document.read = std::move(read);
  options.make_placeholder = network.placeholders();
  options.make_inlets = network.inlets();
  options.read_interface = remote::read_interface;
  options.document.overrides = arguments.overrides;
  options.library_folders = arguments.library_folders;
  options.mode = arguments.mode;
  options.times_file = arguments.times_file;
  return deploy::load_deployment(arguments.file, options);
}

}  // namespace armature::cli
