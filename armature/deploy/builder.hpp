// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "armature/component/registry.hpp"
#include "armature/deploy/load.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::deploy {

/// Makes what stands for a component of another process.
/// @param prototype  a component of its model with the properties that the document gives
using MakePlaceholder = std::function<base::Result<std::unique_ptr<component::Component>>(
    const document::Component& written, std::unique_ptr<component::Component> prototype)>;

/// Makes the prototype of a component that an interface file describes; nullptr after an error.
/// Mistakes of the file are told at their places in it.
/// @param written  its `model` becomes the interface's name
/// @param path     of the file, perhaps with `#` and the interface's name behind it
using ReadInterface = std::function<std::unique_ptr<component::Component>(
    document::Component& written, const std::string& path, base::Diagnostics&)>;

/// Makes the component `kNetworkName`, which writes `inputs`; each of its outputs is called
/// `component.port`.
using MakeInlets = std::function<base::Result<std::unique_ptr<component::Component>>(
    const std::vector<component::InputPortBase*>& inputs)>;

/// What a build needs beside the document.
struct BuildOptions {
  FileReader read;              ///< of property files; empty: from disk
  bool models_missing = false;  ///< a library could not be loaded, so unknown models may be its own
  MakePlaceholder make_placeholder{};  ///< none: components of other processes are refused
  MakeInlets make_inlets{};            ///< none: inputs for other processes are refused
  ReadInterface read_interface{};      ///< none: components of other processes are refused
  /// Is told each property file that was read.
  FileSeen seen{};
};

/// Makes the document's components from the models of `registry`, sets their properties, from
/// property files first, and writes down activities, peers, bindings and connections. Mistakes are
/// added to `diagnostics` at their places; what has one is left out in a way that lets the checks
/// of `exec::make_plan` go on with the rest.
exec::Blueprint build_blueprint(const document::Document& document,
                                const component::Registry& registry, const BuildOptions& options,
                                base::Diagnostics& diagnostics);

/// What the document says about running the application as a whole.
exec::ApplicationOptions application_options(const document::Document& document);

}  // namespace armature::deploy
