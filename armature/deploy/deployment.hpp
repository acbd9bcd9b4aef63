// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/analysis/schedule.hpp"
#include "armature/base/diagnostic.hpp"
#include "armature/component/registry.hpp"
#include "armature/deploy/builder.hpp"
#include "armature/deploy/load.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::deploy {

/// What loading a deployment needs beside its file.
struct DeploymentOptions {
  LoadOptions document;                      ///< overrides of the command line, how files are read
  std::vector<std::string> library_folders;  ///< looked through before all others
  std::function<void(component::Registry&)> models;  ///< adds models of the program itself
  MakePlaceholder make_placeholder;  ///< none: components of other processes are refused
  MakeInlets make_inlets;            ///< none: inputs for other processes are refused
  ReadInterface read_interface;      ///< none: components of other processes are refused
  std::string mode;                  ///< in which it starts, whatever the document says
  std::string times_file;            ///< measured execution times (see schedule.hpp); empty: none
  int cpus = 0;  ///< of the machine that is to run it; 0: as many as this one has
};

/// An application as its files describe it, loaded and checked; nothing of it has moved. Run it
/// with `exec::Application(std::move(d.blueprint), d.options)` if it is ok.
struct Deployment {
  document::Document document;
  component::Registry models;
  exec::Blueprint blueprint;
  exec::ApplicationOptions options;  ///< what the document says; the rest is the caller's
  exec::Plan plan;                   ///< threads and order of execution, if it is ok
  analysis::Schedule schedule;       ///< the load, if it is ok
  base::Diagnostics diagnostics;

  bool ok() const { return diagnostics.ok(); }
};

/// Reads the deployment and what it includes, loads its libraries, makes its components, and checks
/// everything that can be known before start. Finds all mistakes in one run.
Deployment load_deployment(const std::string& path, const DeploymentOptions& options = {});

/// Likewise for text in memory; `name` tells where it is from and chooses the format.
Deployment parse_deployment(std::string_view text, const std::string& name,
                            const DeploymentOptions& options = {});

}  // namespace armature::deploy
