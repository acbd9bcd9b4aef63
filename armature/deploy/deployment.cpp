// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/deployment.hpp"

#include <thread>
#include <utility>

#include "armature/deploy/builder.hpp"
#include "armature/deploy/loader.hpp"
#include "armature/platform/file.hpp"

namespace armature::deploy {
namespace {

ExecutionTimes read_times(const std::string& file, base::Diagnostics& diagnostics) {
  if (file.empty()) return {};
  const base::Result<std::string> text = platform::read_file(file);
  if (text) return parse_times(text.value(), file, diagnostics);
  diagnostics.error({}, text.error());
  return {};
}

int cpus_of(const DeploymentOptions& options) {
  if (options.cpus > 0) return options.cpus;
  const unsigned present = std::thread::hardware_concurrency();
  return present == 0 ? 1 : static_cast<int>(present);
}

/// Nothing is wrong with these, but hardly anybody means it.
void warn_of_idle_components(const Deployment& deployment, base::Diagnostics& diagnostics) {
  const exec::Plan& plan = deployment.plan;
  for (const exec::Index index : plan.threads[plan.service_thread()].members) {
    const exec::ComponentEntry& entry = deployment.blueprint.components[index];
    const component::Interface& interface = entry.component->interface();
    if (interface.inputs.empty() && interface.outputs.empty()) continue;  // tools may call it
    diagnostics.warning(entry.where,
                        "nothing ever runs '" + entry.component->name() +
                            "': it has no activity, and nothing triggers or calls it",
                        "give it one, for example activity: {periodic: 10 ms}");
  }
}

/// Goes on from the document as far as it could be read, so that all mistakes are found in one run.
void complete(Deployment& deployment, const DeploymentOptions& options) {
  base::Diagnostics& diagnostics = deployment.diagnostics;
  if (!options.mode.empty()) deployment.document.mode = {options.mode, {"<command line>", 0, 0}};
  const Document& document = deployment.document;
  if (options.models) options.models(deployment.models);
  const bool all_loaded =
      load_libraries(document.libraries, library_folders(options.library_folders, document.file),
                     deployment.models, diagnostics);
  deployment.options = application_options(document);
  deployment.blueprint =
      build_blueprint(document, deployment.models,
                      {options.document.read, !all_loaded, options.make_placeholder}, diagnostics);
  deployment.plan = exec::make_plan(deployment.blueprint, diagnostics);
  if (diagnostics.ok() && deployment.blueprint.components.empty()) {
    diagnostics.error({document.file, 0, 0}, "the file has no components");
  }
  const ExecutionTimes times = read_times(options.times_file, diagnostics);
  if (!diagnostics.ok()) return;
  warn_of_idle_components(deployment, diagnostics);
  deployment.schedule =
      check_schedule(deployment.blueprint, deployment.plan, times, cpus_of(options), diagnostics);
}

}  // namespace

Deployment load_deployment(const std::string& path, const DeploymentOptions& options) {
  Deployment deployment;
  deployment.document = load_document(path, options.document, deployment.diagnostics);
  complete(deployment, options);
  return deployment;
}

Deployment parse_deployment(std::string_view text, const std::string& name,
                            const DeploymentOptions& options) {
  Deployment deployment;
  deployment.document = parse_document(text, name, options.document, deployment.diagnostics);
  complete(deployment, options);
  return deployment;
}

}  // namespace armature::deploy
