// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/deployment.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/component/interface.hpp"
#include "armature/deploy/builder.hpp"
#include "armature/deploy/internal/operator_inputs.hpp"
#include "armature/deploy/loader.hpp"
#include "armature/deploy/saved_properties.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/platform/file.hpp"

namespace armature::deploy {

using namespace document;
using internal::check_operator_inputs;

namespace {

/// Of the warnings that a deployment may accept; docs/deployment.md explains them.
constexpr std::array<std::string_view, 11> kWarningNames = {
    "priority_inversion", "idle_component",       "late_answer",      "budget_exceeded",
    "missing_cpu",        "service_left_out",     "setting_left_out", "priority_changed",
    "unused_connection",  "slave_without_master", "names_left_out"};

analysis::ExecutionTimes read_times(const std::string& file, base::Diagnostics& diagnostics) {
  if (file.empty()) return {};
  const base::Result<std::string> text = platform::read_file(file);
  if (text) return analysis::parse_times(text.value(), file, diagnostics);
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
    const component::Interface& interface = component::interface_of(*entry.component);
    if (interface.inputs.empty() && interface.outputs.empty()) continue;  // tools may call it
    diagnostics.named_warning(
        "idle_component", entry.where,
        "'" + entry.component->name() +
            "' never runs: it has no activity, and nothing triggers or calls it",
        "give it an activity, for example activity: {periodic: 10 ms}");
  }
}

/// Each has its stack and its place in the system's queues. Hundreds are seldom meant; thousands
/// that are busy leave a machine to nobody, not even to whoever wants to stop them.
void check_threads(const Deployment& deployment, base::Diagnostics& diagnostics) {
  constexpr std::size_t kUsual = 64;
  const auto& threads = deployment.plan.threads;
  const auto count = static_cast<std::size_t>(std::ranges::count_if(
      threads, [](const exec::ThreadPlan& thread) { return !thread.members.empty(); }));
  const std::optional<int>& declared = deployment.document.most_threads;
  const std::size_t most = declared ? static_cast<std::size_t>(*declared) : kUsual;
  if (count <= most) return;
  diagnostics.error({deployment.document.file, 0, 0},
                    "the application has " + std::to_string(count) + " threads, expected at most " +
                        std::to_string(most),
                    "let components be triggered by others instead of having an activity of their "
                    "own, or say threads: " +
                        std::to_string(count));
}

/// Who stands beside a real robot knows when it may move; a script does not.
void refuse_grants_on_hardware(Deployment& deployment) {
  const Document& document = deployment.document;
  if (document.script_grants.empty() || document.grants_on_hardware) return;
  for (const exec::HardwarePlan& hardware : deployment.plan.hardware) {
    const OperationOf& grant = document.script_grants.front();
    deployment.diagnostics.error(grant.where,
                                 "scripts are granted '" + grant.component + "." + grant.operation +
                                     "', but '" + hardware.component->name() +
                                     "' drives a real robot by " + hardware.bus,
                                 "revoke it in the file of this robot with grants: {script: []}, "
                                 "or confirm it with grants: {on_hardware: true}");
    return;
  }
}

/// What looks on must not be able to end a run: who drives would stop because of it.
void refuse_shadows_that_stop_all(Deployment& deployment) {
  if (deployment.options.on_fault != exec::OnFault::kStopAll) return;
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    if (!entry.shadow) continue;
    deployment.diagnostics.error(entry.where,
                                 "the shadow '" + entry.component->name() +
                                     "' would stop everything if it faulted, since on_fault is "
                                     "stop_all",
                                 "say on_fault: stop_dependents, or remove the shadow");
    return;
  }
}

/// Warnings that the deployment means. Errors stay, and so do warnings about what moves, which have
/// no name.
void accept_warnings(const Document& document, base::Diagnostics& diagnostics) {
  std::vector<std::string> known(kWarningNames.begin(), kWarningNames.end());
  for (const Reference& accepted : document.accepted) {
    if (std::ranges::find(known, accepted.name) == known.end()) {
      diagnostics.error(accepted.where,
                        "unknown warning " + in_quotes(accepted.name) + " in accept",
                        base::suggestion(accepted.name, known));
    } else if (!diagnostics.accept(accepted.name) && diagnostics.ok()) {
      diagnostics.warning(
          accepted.where,
          "accept names " + in_quotes(accepted.name) + ", but there is no such warning",
          "remove it");
    }
  }
}

/// Goes on from the document as far as it could be read, so that all mistakes are found in one run.
void check_all(Deployment& deployment, const DeploymentOptions& options) {
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
                      {options.document.read, !all_loaded, options.make_placeholder,
                       options.make_inlets, options.read_interface, options.document.seen},
                      diagnostics);
  take_kept(document, deployment.blueprint, diagnostics);
  deployment.plan = exec::make_plan(deployment.blueprint, diagnostics);
  if (diagnostics.ok() && deployment.blueprint.components.empty()) {
    diagnostics.error({document.file, 0, 0}, "the file has no components",
                      "add them under components:");
  }
  check_operator_inputs(document, deployment.blueprint, deployment.plan, diagnostics);
  const analysis::ExecutionTimes times = read_times(options.times_file, diagnostics);
  refuse_grants_on_hardware(deployment);
  refuse_shadows_that_stop_all(deployment);
  if (!diagnostics.ok()) return;
  warn_of_idle_components(deployment, diagnostics);
  check_threads(deployment, diagnostics);
  deployment.schedule = analysis::check_schedule(deployment.blueprint, deployment.plan, times,
                                                 cpus_of(options), diagnostics);
}

void complete(Deployment& deployment, const DeploymentOptions& options) {
  check_all(deployment, options);
  accept_warnings(deployment.document, deployment.diagnostics);
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
