// SPDX-License-Identifier: Apache-2.0
// The commands that look at deployments and models without running anything.
#include <set>
#include <string>

#include "armature/analysis/wiring_graph.hpp"
#include "armature/base/diagnostic.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/load.hpp"
#include "armature/cli/network.hpp"
#include "armature/cli/new_component.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/deploy/loader.hpp"
#include "armature/document/yaml.hpp"
#include "armature/exec/plan.hpp"
#include "armature/inspect/model_catalogue.hpp"
#include "armature/orocos/deployer_file.hpp"
#include "armature/platform/file.hpp"

namespace armature::cli {
namespace {

using rt::LogLevel;

int print(const base::Result<std::string>& text, const Console& console) {
  if (!text) {
    console.say(LogLevel::kError, text.error());
    return kFailed;
  }
  console.print(text.value());
  return kDone;
}

/// False, and says so, if `path` is one of the files that `document` came from.
bool is_no_source(const std::string& path, const document::Document& document,
                  const Console& console) {
  std::set<std::string> sources{document.file};
  for (const auto& each : document.components) sources.insert(each.where.file);
  for (const auto& each : document.connections) sources.insert(each.where.file);
  for (const auto& each : document.libraries) sources.insert(each.where.file);
  for (const std::string& source : sources) {
    if (!platform::is_same_file(path, source)) continue;
    console.say(LogLevel::kError,
                "'" + path + "' is what is read ('" + source + "'): name another file to write");
    return false;
  }
  return true;
}

int write(const std::string& path, const std::string& content, const Console& console) {
  if (const auto written = platform::write_file(path, content); !written) {
    console.say(LogLevel::kError, written.error());
    return kFailed;
  }
  console.say(LogLevel::kInfo, "wrote " + path);
  return kDone;
}

bool ends_in(const std::string& path, const std::string& ending) {
  return path.size() >= ending.size() &&
         path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

int check(const CheckArguments& arguments, const Console& console) {
  NetworkOnDemand network(console);
  deploy::Deployment deployment = load(arguments.load, network);
  network.check(deployment.document, deployment.diagnostics);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) {
    const std::size_t errors = deployment.diagnostics.error_count();
    console.say(LogLevel::kError, arguments.load.file + ": " + std::to_string(errors) +
                                      (errors == 1 ? " error" : " errors"));
    return kFailed;
  }
  if (arguments.order) {
    console.print(exec::describe_order(deployment.blueprint, deployment.plan));
  }
  if (arguments.load_table) console.print(deployment.schedule.to_text());
  console.say(LogLevel::kInfo,
              arguments.load.file + ": " + std::to_string(deployment.blueprint.components.size()) +
                  " components, " + std::to_string(deployment.plan.connections.size()) +
                  " connections, no errors");
  return kDone;
}

int graph(const GraphArguments& arguments, const Console& console) {
  NetworkOnDemand network(console);
  const deploy::Deployment deployment = load(arguments.load, network);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) return kFailed;
  std::string picture;
  if (arguments.format == "dot") {
    picture = analysis::graph_as_dot(deployment.blueprint, deployment.plan);
  } else if (arguments.format == "mermaid") {
    picture = analysis::graph_as_mermaid(deployment.blueprint, deployment.plan);
  } else {
    picture = analysis::graph_as_svg(deployment.blueprint, deployment.plan);
  }
  if (!arguments.output.empty()) {
    if (!is_no_source(arguments.output, deployment.document, console)) return kWrongUse;
    return write(arguments.output, picture, console);
  }
  return print(picture, console);
}

int models(const ModelsArguments& arguments, const Console& console) {
  component::Registry registry;
  base::Diagnostics diagnostics;
  const std::vector<std::string> folders = deploy::library_folders(arguments.library_folders, "./");
  std::vector<std::string> names = arguments.libraries;
  if (names.empty()) names = deploy::available_libraries(folders);
  std::vector<document::Reference> libraries;
  for (const std::string& name : names) libraries.push_back({name, {}});
  deploy::load_libraries(libraries, folders, registry, diagnostics);
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  if (arguments.json) {
    std::vector<std::string> wanted;
    if (!arguments.name.empty()) wanted.push_back(arguments.name);
    return print(inspect::models_as_json(registry, wanted), console);
  }
  if (arguments.name.empty()) return print(inspect::list_models(registry), console);
  return print(inspect::describe_model(registry, arguments.name), console);
}

int convert(const std::string& from, const std::string& to, const Console& console) {
  if (!ends_in(to, ".xml") && !ends_in(to, ".yaml") && !ends_in(to, ".yml")) {
    console.say(LogLevel::kError, "the name of the file to write says its format: '" + to +
                                      "' must end in .yaml, .yml or .xml");
    return kWrongUse;
  }
  base::Diagnostics diagnostics;
  const document::Document document = deploy::load_document(from, {}, diagnostics);
  std::string text;
  if (diagnostics.ok()) {
    text = ends_in(to, ".xml") ? orocos::write_xml(document, diagnostics)
                               : document::write_yaml(document);
  }
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  if (!is_no_source(to, document, console)) return kWrongUse;
  return write(to, text, console);
}

int new_component(const std::string& name, const Console& console) {
  const auto made = make_component_library(name, ".");
  if (!made) {
    console.say(LogLevel::kError, made.error());
    return kFailed;
  }
  for (const std::string& file : made.value().files) {
    console.print(made.value().folder + "/" + file + "\n");
  }
  console.say(LogLevel::kInfo, "made " + made.value().folder + "; its README.md says how to build");
  return kDone;
}

}  // namespace armature::cli
