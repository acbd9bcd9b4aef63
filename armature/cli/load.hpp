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
/// @param seen     is told of each file; may be empty
inline deploy::Deployment load(const LoadArguments& arguments, NetworkOnDemand& network,
                               deploy::FileReader read = {}, deploy::FileSeen seen = {}) {
  deploy::DeploymentOptions options;
  options.document.read = std::move(read);
  options.document.seen = std::move(seen);
  options.make_placeholder = network.placeholders();
  options.make_inlets = network.inlets();
  options.read_interface = remote::read_interface;
  options.document.overrides = arguments.overrides;
  options.library_folders = arguments.library_folders;
  options.mode = arguments.mode;
  options.times_file = arguments.times_file;
  return deploy::load_deployment(arguments.file, options);
}

/// Likewise, with what the deployment says of the network, for commands that do not run it.
inline deploy::Deployment load_and_check(const LoadArguments& arguments, const Console& console,
                                         deploy::FileReader read = {}) {
  NetworkOnDemand network(console);
  deploy::Deployment deployment = load(arguments, network, std::move(read));
  network.check(deployment.document, deployment.diagnostics);
  return deployment;
}

}  // namespace armature::cli
