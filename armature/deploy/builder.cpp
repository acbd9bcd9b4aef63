// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/builder.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/deploy/internal/call_builder.hpp"
#include "armature/deploy/internal/component_builder.hpp"
#include "armature/deploy/internal/connection_builder.hpp"
#include "armature/deploy/internal/once_per_place.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/exec/inlets.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using ComponentsByName = std::unordered_map<std::string_view, const component::Component*>;

ComponentsByName by_name(const exec::Blueprint& blueprint) {
  ComponentsByName made;
  for (const exec::ComponentEntry& entry : blueprint.components) {
    made.emplace(entry.component->name(), entry.component.get());
  }
  return made;
}

/// Two components that save to one file would overwrite each other's values.
void check_saved_files(const Document& document, base::Diagnostics& diagnostics) {
  std::map<std::string, const Component*> owners;
  for (const Component& component : document.components) {
    if (!component.autosave || component.property_files.empty()) continue;
    const PropertyFile& file = component.property_files.back();
    const auto [owner, first] = owners.emplace(path_from(document, file.path), &component);
    if (first) continue;
    diagnostics.error(file.where,
                      in_quotes(component.name) + " and " + in_quotes(owner->second->name) +
                          " both save their properties to " + path_in_quotes(file.path),
                      "give each its own file");
  }
}

component::InputPortBase* find_input(const exec::Blueprint& blueprint, const Endpoint& end,
                                     base::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const exec::ComponentEntry& entry : blueprint.components) {
    if (entry.component->name() != end.component) {
      names.push_back(entry.component->name());
      continue;
    }
    std::vector<std::string> ports;
    for (component::InputPortBase* const port : component::interface_of(*entry.component).inputs) {
      if (port->name() == end.port) return port;
      ports.push_back(port->name());
    }
    diagnostics.error(end.where, in_quotes(end.component) + " has no input " + in_quotes(end.port),
                      base::suggestion(end.port, ports));
    return nullptr;
  }
  if (blueprint.absent.count(end.component) == 0) {
    diagnostics.error(end.where, "unknown component " + in_quotes(end.component),
                      base::suggestion(end.component, names));
  }
  return nullptr;
}

/// The component that writes what others send. What comes from elsewhere may stop coming: so each
/// of the inputs has an age.
void add_inlets(const Document& document, const BuildOptions& options, exec::Blueprint& blueprint,
                base::Diagnostics& diagnostics) {
  if (document.network.inputs.empty()) return;
  std::vector<component::InputPortBase*> inputs;
  for (const Connection& connection : document.network.inputs) {
    component::InputPortBase* const input = find_input(blueprint, connection.to, diagnostics);
    if (input == nullptr) continue;
    inputs.push_back(input);
    if (connection.policy.max_age || input->ages()) continue;
    diagnostics.error(
        connection.where,
        in_quotes(to_text(connection.to)) +
            " is written by other processes, which may stop at any time, but has no max_age",
        "add one, for example {to: " + to_text(connection.to) + ", max_age: 100 ms}");
  }
  const base::Location& where = document.network.inputs.front().where;
  if (!options.make_inlets) {
    diagnostics.error(
        where, "network inputs come from other processes, and this program does not connect to any",
        "run it with armature run, or leave out inputs");
    return;
  }
  auto inlets = options.make_inlets(inputs);
  if (!inlets) return diagnostics.error(where, inlets.error());
  exec::Activity activity;
  activity.kind = exec::Activity::Kind::kTriggered;
  blueprint.components.push_back(
      {std::move(inlets).value(), "Inlets", std::move(activity), {}, {}, where});
}

/// The component that writes what the operator gives.
void add_operator_inputs(const Document& document, exec::Blueprint& blueprint,
                         base::Diagnostics& diagnostics) {
  if (document.operator_inputs.empty()) return;
  std::vector<component::InputPortBase*> inputs;
  for (const Connection& connection : document.operator_inputs) {
    component::InputPortBase* const input = find_input(blueprint, connection.to, diagnostics);
    if (input != nullptr) inputs.push_back(input);
  }
  exec::Activity activity;
  activity.kind = exec::Activity::Kind::kTriggered;
  blueprint.components.push_back({std::make_unique<exec::Inlets>(exec::kOperatorName, inputs),
                                  "Inlets",
                                  std::move(activity),
                                  {},
                                  {},
                                  document.operator_inputs.front().where});
}

/// What may be named, and how that reads in "'A' has no command 'b' without arguments".
struct Choice {
  bool (*fits)(const component::OperationBase&);
  bool properties;  ///< those that are acts of the operator fit, too
  const char* kind;
  const char* more;
};

constexpr Choice kCanBeGranted = {
    [](const component::OperationBase& operation) { return operation.is_by_operator(); }, true,
    "act of the operator", "that could be granted"};
constexpr Choice kCanComeLast = {[](const component::OperationBase& operation) {
                                   return operation.is_command() &&
                                          operation.signature().arguments.empty();
                                 },
                                 false, "command", "without arguments"};

/// Whether they are there would else be found out when they are used.
void check_operations(const std::vector<OperationOf>& wanted, const exec::Blueprint& blueprint,
                      const Choice& choice, base::Diagnostics& diagnostics) {
  const ComponentsByName made = by_name(blueprint);
  std::vector<std::string> names;
  for (const exec::ComponentEntry& entry : blueprint.components) {
    names.push_back(entry.component->name());
  }
  for (const OperationOf& one : wanted) {
    if (blueprint.absent.count(one.component) > 0) continue;
    const auto found = made.find(one.component);
    if (found == made.end()) {
      diagnostics.error(one.where, "unknown component " + in_quotes(one.component),
                        base::suggestion(one.component, names));
      continue;
    }
    std::vector<std::string> fitting;
    for (const component::OperationBase* operation :
         component::interface_of(*found->second).operations) {
      if (choice.fits(*operation)) fitting.emplace_back(operation->name());
    }
    for (const component::PropertyBase* property :
         component::interface_of(*found->second).properties) {
      if (choice.properties && property->is_by_operator()) fitting.emplace_back(property->name());
    }
    if (std::find(fitting.begin(), fitting.end(), one.operation) != fitting.end()) continue;
    diagnostics.error(one.where,
                      in_quotes(one.component) + " has no " + choice.kind + " " +
                          in_quotes(one.operation) + " " + choice.more,
                      base::suggestion(one.operation, fitting));
  }
}

template <typename List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto* one : list) names.emplace_back(one->name());
  return names;
}

/// The names of what a component has of the kind that is exported.
std::vector<std::string> exportable(const component::Interface& interface, ExportKind kind) {
  switch (kind) {
    case ExportKind::kOperation:
      return names_of(interface.operations);
    case ExportKind::kEvent:
      return names_of(interface.events);
    case ExportKind::kProperty:
      return names_of(interface.properties);
    case ExportKind::kPort:
      break;
  }
  std::vector<std::string> ports = names_of(interface.outputs);
  for (std::string& input : names_of(interface.inputs)) ports.push_back(std::move(input));
  return ports;
}

/// What a composite exports is there, used or not. A mistake of a composite is told once.
void check_exports(const Document& document, const exec::Blueprint& blueprint,
                   base::Diagnostics& diagnostics) {
  if (document.composites.empty()) return;
  const ComponentsByName made = by_name(blueprint);
  internal::OncePerPlace reports(diagnostics);
  for (const Composite& composite : document.composites) {
    base::Diagnostics found;
    for (const Export& one : composite.exports) {
      const auto part = made.find(one.component);
      if (part == made.end()) continue;  // it is missing, which was reported
      const std::vector<std::string> names =
          exportable(component::interface_of(*part->second), one.kind);
      if (std::find(names.begin(), names.end(), one.member) != names.end()) continue;
      found.error(one.where,
                  "composite " + in_quotes(composite.model) + " exports " + in_quotes(one.name) +
                      ", but " + in_quotes(one.component) + " has no " +
                      std::string(name_of(one.kind)) + " " + in_quotes(one.member),
                  base::suggestion(one.member, names));
    }
    reports.add(found);
  }
}

void add_modes(const Document& document, exec::Blueprint& blueprint) {
  for (const Mode& mode : document.modes) {
    std::vector<exec::ModeMember> members;
    for (const Reference& each : mode.components) members.push_back({each.name, each.where});
    blueprint.add_mode(mode.name, std::move(members), mode.where);
  }
  blueprint.initial_mode = {document.mode.name, document.mode.where};
}

}  // namespace

exec::Blueprint build_blueprint(const Document& document, const component::Registry& registry,
                                const BuildOptions& options, base::Diagnostics& diagnostics) {
  exec::Blueprint blueprint;
  if (!document.application.empty()) blueprint.name = document.application;
  check_saved_files(document, diagnostics);
  // A name that still stands for a composite could not be resolved, which was reported. Where all
  // were, nothing is absent: components are checked only then.
  if (!diagnostics.ok()) {
    for (const Composite& composite : document.composites) blueprint.absent.insert(composite.name);
  }
  blueprint.components.reserve(document.components.size());
  internal::ComponentBuilder components(document, registry, options, diagnostics);
  for (const Component& component : document.components) components.build(component, blueprint);
  add_inlets(document, options, blueprint, diagnostics);
  add_operator_inputs(document, blueprint, diagnostics);
  add_modes(document, blueprint);
  internal::CallBuilder(document, blueprint, diagnostics).build();
  internal::ConnectionBuilder(document, blueprint, diagnostics).build();
  check_exports(document, blueprint, diagnostics);
  check_operations(document.script_grants, blueprint, kCanBeGranted, diagnostics);
  check_operations(document.remote_grants, blueprint, kCanBeGranted, diagnostics);
  check_operations(document.before_stop, blueprint, kCanComeLast, diagnostics);
  return blueprint;
}

exec::ApplicationOptions application_options(const Document& document) {
  exec::ApplicationOptions options;
  options.on_fault = document.on_fault;
  const BlackBox& box = document.black_box;
  if (box.history) options.black_box.history = *box.history;
  if (!box.kept) options.black_box.history = base::Duration::zero();
  if (box.memory_kb) options.black_box.memory = static_cast<std::size_t>(*box.memory_kb) * 1000;
  if (document.hold_at_stop) options.hold_at_stop = *document.hold_at_stop;
  for (const OperationOf& grant : document.script_grants) {
    options.grants.push_back({exec::Caller::kScript, grant.component, grant.operation});
  }
  for (const OperationOf& grant : document.remote_grants) {
    options.grants.push_back({exec::Caller::kRemote, grant.component, grant.operation});
  }
  for (const OperationOf& command : document.before_stop) {
    options.before_stop.push_back({command.component, command.operation});
  }
  return options;
}

}  // namespace armature::deploy
