// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <exception>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/properties/keeping.hpp"
#include "armature/component/states/state_machine.hpp"
#include "armature/deploy/internal/component_builder.hpp"
#include "armature/deploy/internal/overrides.hpp"
#include "armature/document/property_value.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/inspect/model_mistakes.hpp"
#include "armature/orocos/property_file.hpp"
#include "armature/platform/file.hpp"

namespace armature::deploy::internal {

using namespace document;
namespace {

/// A priority alone asks for real time.
exec::Activity with_scheduler(const Activity& written) {
  exec::Activity activity = written;
  if (!written.scheduler_given && written.priority > 0) {
    activity.scheduler = exec::Activity::Scheduler::kRealtime;
  }
  return activity;
}

/// What lives in another process has a thread here that waits for it, and is never real-time.
exec::Activity activity_of(const Component& written) {
  if (written.remote.name.empty()) return with_scheduler(written.activity);
  exec::Activity activity;
  activity.kind = exec::Activity::Kind::kTriggered;
  return activity;
}

component::PropertyBase* find_property(const component::Component& component,
                                       std::string_view name) {
  for (component::PropertyBase* property : component::interface_of(component).properties) {
    if (property->name() == name) return property;
  }
  return nullptr;
}

/// True if the number or size of ports follows from a property: while its value is unknown, nothing
/// can be said about the component's connections.
bool shapes_ports(const component::PropertyBase& property) {
  const component::Interface& interface = component::interface_of(property.owner());
  const auto counts = [&](const auto* array) { return &array->count() == &property; };
  const auto sizes = [&](const auto* port) { return port->declared_size().property == &property; };
  return std::any_of(interface.port_arrays.begin(), interface.port_arrays.end(), counts) ||
         std::any_of(interface.inputs.begin(), interface.inputs.end(), sizes) ||
         std::any_of(interface.outputs.begin(), interface.outputs.end(), sizes);
}

/// Those that name the unit of others come first: what `45 deg` means follows from it.
std::vector<const Property*> units_first(const std::vector<Property>& properties,
                                         const component::Component& component) {
  std::vector<const Property*> ordered;
  for (const Property& given : properties) ordered.push_back(&given);
  std::stable_partition(ordered.begin(), ordered.end(), [&](const Property* given) {
    const auto& all = component::interface_of(component).properties;
    return std::any_of(all.begin(), all.end(), [given](const component::PropertyBase* one) {
      return one->unit_property() != nullptr && one->unit_property()->name() == given->name;
    });
  });
  return ordered;
}

/// A mandatory property that was given, though wrongly, is not also reported as missing.
void count_as_given(component::PropertyBase& property) {
  const types::Value present(property.type(), property.data());
  if (property.check(present).empty()) static_cast<void>(property.set(present));
}

/// What only the operator can know is said for one run; a file says it for ever. Its default, which
/// says nothing, may stand in a file.
bool may_be_given(const component::PropertyBase& property, const Value& written,
                  base::Diagnostics& diagnostics) {
  if (!property.is_by_operator() || written.where.file == kCommandLineName) return true;
  const types::Value nothing(property.type(), property.data());
  if (written.text == nothing.text()) return true;
  const std::string item = property.owner().name() + "." + std::string(property.name());
  diagnostics.error(
      written.where,
      in_quotes(item) + " is the operator's word, which counts once, so a file cannot give it",
      "set it for this run: --set " + item + "=" + written.text);
  return false;
}

/// A requirement may name its peer as the component knows it; the runtime knows full names only.
template <typename Requirements>
void bind_by_alias(const Requirements& requirements, const Peer& peer,
                   std::vector<exec::BindingEntry>& bindings) {
  for (const auto* requirement : requirements) {
    if (requirement->peer_name() != peer.name) continue;
    const bool bound = std::any_of(bindings.begin(), bindings.end(), [&](const auto& binding) {
      return binding.requirement == requirement->name();
    });
    if (bound) continue;
    bindings.push_back({std::string(requirement->name()), peer.component, {}, peer.where});
  }
}

void add_peers(const Component& written, exec::ComponentEntry& entry) {
  for (const Binding& binding : written.bindings) {
    entry.bindings.push_back({binding.name, binding.component, binding.member, binding.where});
  }
  const component::Interface& interface = component::interface_of(*entry.component);
  for (const Peer& peer : written.peers) {
    entry.peers.push_back({peer.component, peer.where, peer.superior});
    if (peer.name == peer.component) continue;
    bind_by_alias(interface.callers, peer, entry.bindings);
    bind_by_alias(interface.handlers, peer, entry.bindings);
  }
}

}  // namespace

void ComponentBuilder::build(const Component& written, exec::Blueprint& blueprint) {
  if (written.interface.name.empty()) return add(written, make(written), blueprint);
  Component described = written;
  auto prototype = read_interface(described);
  add(described, std::move(prototype), blueprint);
}

/// Several components may have one file, whose mistakes are told once.
std::unique_ptr<component::Component> ComponentBuilder::read_interface(Component& written) {
  if (!options_.read_interface) {
    refuse_other_processes(written);
    return nullptr;
  }
  base::Diagnostics found;
  auto prototype =
      options_.read_interface(written, path_from(document_, written.interface.name), found);
  of_interfaces_.add(found);
  return prototype;
}

void ComponentBuilder::refuse_other_processes(const Component& written) {
  diagnostics_.error(written.remote.where,
                     in_quotes(written.name) +
                         " lives in another process, and this program does not connect to any");
}

void ComponentBuilder::add(const Component& written,
                           std::unique_ptr<component::Component> component,
                           exec::Blueprint& blueprint) {
  const bool whole = component != nullptr && set_properties(written, *component);
  if (whole) component = settle(written, std::move(component));
  if (!whole || component == nullptr) {
    blueprint.absent.insert(written.name);
    return;
  }
  exec::ComponentEntry entry{std::move(component), written.model, activity_of(written), {}, {},
                             written.where};
  if (entry.activity.priority > 0) {
    entry.activity.priority = priorities_.here(entry.activity.priority);
  }
  entry.autoconfigure = written.autoconf;
  entry.autostart = written.autostart;
  entry.shadow = written.shadow;
  add_peers(written, entry);
  blueprint.components.push_back(std::move(entry));
}

std::unique_ptr<component::Component> ComponentBuilder::settle(
    const Component& written, std::unique_ptr<component::Component> component) {
  if (written.remote.name.empty()) return component;
  const Activity& activity = written.activity;
  if (activity.kind != Activity::Kind::kSequential) {
    diagnostics_.error(
        activity.where,
        in_quotes(written.name) + " lives in another process, which has its activity",
        "leave out activity");
  }
  if (!options_.make_placeholder) {
    refuse_other_processes(written);
    return nullptr;
  }
  for (const component::PropertyBase* property : component::interface_of(*component).mandatory) {
    if (property->was_set() || !shapes_ports(*property)) continue;
    diagnostics_.error(written.where,
                       in_quotes(written.name) + " needs the property " +
                           in_quotes(property->name()) + ", which determines its ports",
                       "give it the value that it has in the other process");
  }
  auto placeholder = options_.make_placeholder(written, std::move(component));
  if (placeholder) return std::move(placeholder).value();
  diagnostics_.error(written.remote.where,
                     in_quotes(written.name) + ", remote: " + placeholder.error());
  return nullptr;
}

std::unique_ptr<component::Component> ComponentBuilder::make(const Component& written) {
  if (written.model.empty()) return nullptr;  // reported by whoever read the document
  const component::Registry::Model* model = registry_.find(written.model);
  if (model == nullptr) {
    report_unknown_model(written);
    return nullptr;
  }
  std::string problem = "returns no component";
  try {
    if (auto component = model->make(written.name)) {
      if (known_models_.insert(model).second) report_units(written, *model, *component);
      report_machines(written, *component);
      return component;
    }
  } catch (const std::exception& exception) {
    problem = std::string("throws: ") + exception.what();
  } catch (...) {
    problem = "throws an object that is not a std::exception";
  }
  diagnostics_.error(written.where, in_quotes(written.name) +
                                        " cannot be made: the constructor of model " +
                                        in_quotes(written.model) + " " + problem);
  return nullptr;
}

/// Mistakes of the model, told once, at the first of its components.
void ComponentBuilder::report_units(const Component& written,
                                    const component::Registry::Model& model,
                                    const component::Component& component) {
  for (std::string& mistake : inspect::mistakes_of_model(component, model)) {
    diagnostics_.error(written.model_where, std::move(mistake));
  }
}

/// Mistakes in how the author listed states and transitions.
void ComponentBuilder::report_machines(const Component& written,
                                       const component::Component& component) {
  for (const component::StateMachine* machine : component::interface_of(component).machines) {
    for (const std::string& problem : machine->problems()) {
      diagnostics_.error(written.where, in_quotes(written.name) + ", state machine " +
                                            in_quotes(machine->name()) + ": " + problem);
    }
  }
}

void ComponentBuilder::report_unknown_model(const Component& written) {
  if (model_names_.empty()) model_names_ = registry_.names();
  const bool may_be_missing =
      options_.models_missing && base::near_name(written.model, model_names_).empty();
  if (may_be_missing) return;
  base::Hint hint = base::suggestion(written.model, model_names_);
  if (hint.empty()) hint = "list its library under libraries:";
  diagnostics_.error(
      written.model_where,
      "component " + in_quotes(written.name) + ": unknown model " + in_quotes(written.model),
      std::move(hint));
}

/// False if a mistake leaves the component's ports unknown.
bool ComponentBuilder::set_properties(const Component& written, component::Component& component) {
  bool ports_known = set_number_in_name(written, component);
  for (const PropertyFile& file : written.property_files) {
    ports_known &= apply_property_file(written, file, component);
  }
  ports_known &= apply(written, written.properties, component);
  if (ports_known) check_number_in_name(written, component);
  return ports_known;
}

bool ComponentBuilder::set_number_in_name(const Component& written,
                                          component::Component& component) {
  const auto number = registry_.number_in(written.model);
  if (!number) return true;
  component::PropertyBase* const property = find_property(component, number->property);
  if (property == nullptr) {
    diagnostics_.error(written.model_where, "the model of " + in_quotes(written.model) +
                                                " has no property " + in_quotes(number->property) +
                                                " for the number in that name");
    return true;
  }
  return set_property(*property, make_text(number->value, written.model_where), diagnostics_);
}

void ComponentBuilder::check_number_in_name(const Component& written,
                                            const component::Component& component) {
  const auto number = registry_.number_in(written.model);
  const component::PropertyBase* const property =
      number ? find_property(component, number->property) : nullptr;
  if (property == nullptr) return;
  const std::string given = types::to_text(property->type(), property->data());
  if (given == number->value) return;
  const Property* const here = find(written.properties, number->property);
  diagnostics_.error(here == nullptr ? written.model_where : here->where,
                     in_quotes(written.name) + " has " + number->property + " " + number->value +
                         " by its model " + in_quotes(written.model) + ", found " +
                         in_quotes(given),
                     "leave out " + number->property + ", or give another model");
}

/// No file keeps an attribute: one in a property file would be there in no file that is saved.
void ComponentBuilder::refuse_attributes(const Component& written,
                                         const std::vector<Property>& properties,
                                         component::Component& component) {
  for (const Property& given : properties) {
    const component::PropertyBase* const property = find_property(component, given.name);
    if (property == nullptr || property->persistent()) continue;
    diagnostics_.error(given.where,
                       in_quotes(given.name) + " of " + in_quotes(written.name) + " (" +
                           written.model + ") is an attribute, which a property file cannot give",
                       "remove it from the file");
  }
}

bool ComponentBuilder::apply_property_file(const Component& written, const PropertyFile& file,
                                           component::Component& component) {
  const bool own = written.autosave && &file == &written.property_files.back();
  const std::vector<Property>* properties = read(file, own);
  if (properties == nullptr) return true;
  std::string missing;
  auto* const keeps = dynamic_cast<component::Keeps*>(&component);
  for (const component::PropertyBase* property : component::interface_of(component).properties) {
    const bool filled = keeps != nullptr && keeps->keeping().fills(*property);
    const bool wanted = file.complete && property->persistent() && !filled;
    if (!wanted || find(*properties, property->name()) != nullptr) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(property->name());
  }
  if (!missing.empty()) {
    diagnostics_.error(file.where,
                       "property file " + path_in_quotes(file.path) + " of " +
                           in_quotes(written.name) + " must be complete, but lacks " + missing,
                       "add what is missing, or leave out complete");
  }
  refuse_attributes(written, *properties, component);
  return apply(written, *properties, component);
}

bool ComponentBuilder::apply(const Component& written, const std::vector<Property>& properties,
                             component::Component& component) {
  bool ports_known = true;
  std::set<const component::PropertyBase*> mistaken;
  for (const Property* one : units_first(properties, component)) {
    const Property& given = *one;
    component::PropertyBase* const property = find_property(component, given.name);
    if (property == nullptr) {
      std::vector<std::string> names;
      for (const auto* known : component::interface_of(component).properties)
        names.emplace_back(known->name());
      diagnostics_.error(given.where,
                         in_quotes(written.name) + " (" + written.model + ") has no property " +
                             in_quotes(given.name),
                         base::suggestion(given.name, names));
      continue;
    }
    const bool reported = given.value.kind == Value::Kind::kNone ||
                          mistaken.contains(property->unit_property()) ||
                          !may_be_given(*property, given.value, diagnostics_);
    if (!reported && set_property(*property, given.value, diagnostics_)) continue;
    mistaken.insert(property);
    count_as_given(*property);
    ports_known &= !shapes_ports(*property);
  }
  return ports_known;
}

const std::vector<Property>* ComponentBuilder::read(const PropertyFile& file, bool may_be_missing) {
  const std::string path = path_from(document_, file.path);
  if (const auto known = files_.find(path); known != files_.end()) return known->second.get();
  auto& content = files_[path];
  std::error_code ignored;
  const bool from_disk = options_.read == nullptr;
  const auto is_there = [&] {
    return from_disk ? std::filesystem::exists(path, ignored) : options_.read(path).ok();
  };
  if (may_be_missing && !is_there()) {
    diagnostics_.note(file.where, "property file " + path_in_quotes(path) +
                                      " does not exist yet; it is written at stop");
    return nullptr;
  }
  const base::Result<std::string> text =
      from_disk ? platform::read_file(path) : options_.read(path);
  if (!text) {
    diagnostics_.error(file.where, text.error());
    return nullptr;
  }
  if (options_.seen) options_.seen(path, text.value());
  content =
      std::make_unique<std::vector<Property>>(orocos::parse_cpf(text.value(), path, diagnostics_));
  return content.get();
}

}  // namespace armature::deploy::internal
