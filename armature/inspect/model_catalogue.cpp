// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/model_catalogue.hpp"

#include <exception>
#include <memory>
#include <utility>

#include "armature/base/alternatives.hpp"
#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/base/text_table.hpp"
#include "armature/inspect/describe.hpp"
#include "armature/inspect/internal/model_description.hpp"
#include "armature/inspect/model_mistakes.hpp"

namespace armature::inspect {
namespace {

using base::Row;
using component::Registry;

std::string number(double value) { return types::Value::of(value).text(); }

/// Adds `what` to a list separated by commas.
void add(std::string& list, const std::string& what) { list += (list.empty() ? "" : ", ") + what; }

std::string with_notes(const std::string& doc, const std::string& notes) {
  return notes.empty() ? doc : doc + " (" + notes + ")";
}

/// The unit, or the property that names it: `(Unit)`.
template <typename Described>
std::string unit_of(const Described& described) {
  const bool named = described.unit.empty() && !described.unit_property.empty();
  return named ? "(" + described.unit_property + ")" : described.unit;
}

Row row_of(const PropertyDescription& property) {
  std::string notes;
  if (property.mandatory) {
    add(notes, "mandatory");
  } else {
    add(notes, "default " + (property.value.empty() ? "\"\"" : property.value));
  }
  if (!property.values.empty()) add(notes, base::alternatives(property.values));
  if (property.range)
    add(notes, number(property.range->low) + " .. " + number(property.range->high));
  if (!property.persistent) add(notes, "attribute");
  if (property.changeable_while_running) add(notes, "changeable while running");
  return {property.name, property.type, unit_of(property), with_notes(property.doc, notes)};
}

std::string port_notes(const PortDescription& port) {
  if (!port.values.empty()) return base::alternatives(port.values);
  return port.size ? std::to_string(*port.size) + " elements" : "";
}

Row row_of(const InputDescription& port) {
  std::string notes = port_notes(port);
  if (port.triggers) add(notes, "triggers");
  if (port.may_stay_open) add(notes, "may stay open");
  if (port.allows_fan_in) add(notes, "takes several writers");
  if (port.max_age > base::Duration::zero()) {
    add(notes, "at most " + base::to_text(port.max_age) + " old, else " +
                   std::string(component::name_of(port.when_stale)));
  }
  return {port.name, port.type, unit_of(port), with_notes(port.doc, notes)};
}

Row row_of(const OutputDescription& port) {
  return {port.name, port.type, unit_of(port), with_notes(port.doc, port_notes(port))};
}

Row row_of(const PortArrayDescription& array) {
  return {array.name + "1..N", "N is the property " + array.count};
}

Row row_of(const OperationDescription& operation) {
  std::string notes;
  if (operation.command) {
    add(notes, "command with completion");
  } else if (operation.own_thread) {
    add(notes, "in its own thread");
  }
  if (operation.by_operator) add(notes, "by the operator");
  return {operation.name, operation.signature, with_notes(operation.doc, notes)};
}

Row row_of(const EventDescription& event) { return {event.name, event.signature, event.doc}; }

Row row_of(const RequirementDescription& requirement) {
  std::string notes = requirement.event ? "event" : requirement.command ? "command" : "operation";
  if (requirement.optional) add(notes, "optional");
  if (!requirement.wanted) add(notes, "only if a property asks for it");
  return {requirement.name, requirement.signature, with_notes(requirement.doc, notes)};
}

template <typename Items>
std::string section(const char* title, const Items& items) {
  if (items.empty()) return {};
  std::vector<Row> rows;
  for (const auto& item : items) rows.push_back(row_of(item));
  return "\n" + std::string(title) + "\n" + base::table_text(rows, "  ");
}

std::string machine_text(const MachineDescription& machine) {
  std::string text = "\nstate machine " + machine.name + ": " + machine.doc + "\n";
  std::vector<Row> states;
  for (const auto& state : machine.states) states.push_back({state.path, state.doc});
  text += base::table_text(states, "  ");
  for (const std::string& transition : machine.transitions) text += "  " + transition + "\n";
  return text;
}

std::string text_of(const ComponentDescription& description) {
  std::string text =
      section("properties", description.properties) + section("inputs", description.inputs) +
      section("outputs", description.outputs) + section("port arrays", description.port_arrays) +
      section("operations", description.operations) + section("events", description.events) +
      section("requires from its peers", description.requirements);
  for (const auto& machine : description.machines) text += machine_text(machine);
  return text;
}

/// `; also Sensor#Mux (# is joints)`.
std::string further_names(const Registry::Model& model) {
  std::string names;
  for (const Registry::FurtherName& one : model.further_names) {
    const std::string number = one.property.empty() ? "" : " (# is " + one.property + ")";
    add(names, one.name + number);
  }
  return names.empty() ? names : "; also " + names;
}

std::string origin(const Registry::Model& model) {
  return model.library.empty() ? "the program" : model.library;
}

std::string granularity(const Registry::Model& model) {
  return std::string(types::name_of(model.granularity));
}

}  // namespace

namespace internal {

base::Result<ComponentDescription> describe_model(const Registry::Model& model) {
  std::string problem = "returns no component";
  try {
    const std::unique_ptr<component::Component> made = model.make(model.name);
    if (made != nullptr) {
      std::string mistakes;
      for (const std::string& one : mistakes_of_model(*made, model)) {
        mistakes += (mistakes.empty() ? "" : "; ") + one;
      }
      if (!mistakes.empty()) return base::Error{std::move(mistakes)};
      return describe(*made, model.name);
    }
  } catch (const std::exception& exception) {
    problem = std::string("throws: ") + exception.what();
  } catch (...) {
    problem = "throws an object that is not a std::exception";
  }
  return base::Error{"the constructor of model " + base::quoted(model.name) + " " + problem};
}

base::Result<const Registry::Model*> find_model(const Registry& registry, std::string_view name) {
  if (const Registry::Model* model = registry.find(name)) return model;
  const std::string suggestion = base::suggestion(name, registry.names()).text;
  return base::Error{"unknown model " + base::quoted(name) +
                     (suggestion.empty() ? "" : "; " + suggestion)};
}

}  // namespace internal

std::string list_models(const Registry& registry) {
  std::vector<Row> rows;
  for (const std::string& name : registry.names()) {
    const Registry::Model& model = *registry.find(name);
    rows.push_back({name, granularity(model), origin(model), model.doc + further_names(model)});
  }
  return base::table_text(rows);
}

std::string describe_members(const component::Component& component) {
  return text_of(describe(component, {}));
}

base::Result<std::string> describe_model(const Registry& registry, std::string_view name) {
  const auto model = internal::find_model(registry, name);
  if (!model) return base::Error{model.error()};
  const auto description = internal::describe_model(*model.value());
  if (!description) return base::Error{description.error()};
  return model.value()->name + ": " + model.value()->doc + further_names(*model.value()) + " (" +
         granularity(*model.value()) + ", library " + origin(*model.value()) + ")\n" +
         text_of(description.value());
}

}  // namespace armature::inspect
