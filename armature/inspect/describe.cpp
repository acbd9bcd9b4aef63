// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/describe.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/alternatives.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/calls_by_name.hpp"
#include "armature/component/ports/port_array.hpp"
#include "armature/inspect/internal/snapshot.hpp"
#include "armature/types/elements.hpp"

namespace armature::inspect {

using namespace component;
namespace {

std::string joined(const auto& member) {
  return member.owner().name() + "." + std::string(member.name());
}

std::string name_of_unit(const Property<std::string>* property) {
  return property == nullptr ? std::string() : std::string(property->name());
}

/// The structs that a type has in it, each once.
void add_fields(const types::Type& type, std::vector<FieldDescription>& fields) {
  if (types::is_list(type)) return add_fields(*type.element, fields);
  if (type.kind != types::Kind::kStruct) return;
  const bool known = std::any_of(fields.begin(), fields.end(), [&](const FieldDescription& field) {
    return field.structure == type.name;
  });
  if (known) return;
  for (const types::Field& field : type.fields) {
    fields.push_back({std::string(type.name), std::string(field.name), field.type->name,
                      std::string(field.unit), std::string(field.doc),
                      types::enumerator_names(*field.type)});
  }
  for (const types::Field& field : type.fields) add_fields(*field.type, fields);
}

std::vector<ArgumentDescription> arguments_of(const Signature& signature) {
  std::vector<ArgumentDescription> arguments;
  for (const auto& argument : signature.arguments) {
    arguments.push_back({std::string(argument.name), argument.type->name});
  }
  return arguments;
}

/// Puts a component's members and what is known of their values into its description.
class Describer {
 public:
  Describer(const internal::Snapshot* snapshot, Values values)
      : snapshot_(snapshot), with_values_(values == Values::kIncluded) {}

  ComponentDescription describe(const Interface& all) {
    description_.answered = snapshot_ != nullptr;
    for (std::size_t i = 0; i < all.properties.size(); ++i) add(*all.properties[i], i);
    for (std::size_t i = 0; i < all.inputs.size(); ++i) add(*all.inputs[i], i);
    for (std::size_t i = 0; i < all.outputs.size(); ++i) add(*all.outputs[i], i);
    for (const auto* one : all.port_arrays) {
      description_.port_arrays.push_back(
          {std::string(one->name()), std::string(one->count().name())});
    }
    const bool live = snapshot_ != nullptr;  // a model has all that it may offer
    for (const auto* one : all.operations) {
      if (!live || one->is_offered()) add(*one);
    }
    for (std::size_t i = 0; i < all.events.size(); ++i) add(*all.events[i], i);
    for (std::size_t i = 0; i < all.callers.size(); ++i) add(*all.callers[i], i);
    for (std::size_t i = 0; i < all.handlers.size(); ++i) add(*all.handlers[i], i);
    for (std::size_t i = 0; i < all.machines.size(); ++i) add(*all.machines[i], i);
    return std::move(description_);
  }

 private:
  void add(const PropertyBase& from, std::size_t i) {
    PropertyDescription to;
    to.name = from.name();
    to.doc = from.doc();
    to.type = from.type().name;
    to.values = types::enumerator_names(from.type());
    to.unit = from.unit();
    to.unit_property = name_of_unit(from.unit_property());
    to.range = from.limits();
    to.persistent = from.persistent();
    to.changeable_while_running = from.changeable();
    to.mandatory = from.is_mandatory();
    to.by_operator = from.is_by_operator();
    to.was_set = from.was_set();
    if (snapshot_ != nullptr && with_values_) to.value = snapshot_->properties[i].whole.text();
    add_fields(from.type(), description_.fields);
    description_.properties.push_back(std::move(to));
  }

  /// @param reading  nullptr: not known
  void add(const PortBase& from, const Reading* reading, PortDescription& to) {
    to.name = from.name();
    to.doc = from.doc();
    to.type = from.type().name;
    to.values = types::enumerator_names(from.type());
    to.unit = from.unit();
    to.unit_property = name_of_unit(from.unit_property());
    if (from.declared_size().declared()) to.size = from.declared_size().value();
    add_fields(from.type(), description_.fields);
    if (reading == nullptr) return;
    to.written = reading->written;
    to.age = reading->age;
    to.sequence = reading->sequence;
    if (reading->written && with_values_) to.value = reading->whole.text();
  }

  void add(const InputPortBase& from, std::size_t i) {
    InputDescription to;
    add(from, snapshot_ == nullptr ? nullptr : &snapshot_->inputs[i], to);
    for (const OutputPortBase* writer : from.writers()) to.peers.push_back(joined(*writer));
    to.triggers = from.triggers();
    to.may_stay_open = from.stays_open();
    to.allows_fan_in = from.allows_fan_in();
    to.max_age = from.max_age();
    to.when_stale = from.stale_reaction();
    to.when_lost = from.lost_reaction();
    if (snapshot_ != nullptr) to.counters = snapshot_->input_counters[i];
    description_.inputs.push_back(std::move(to));
  }

  void add(const OutputPortBase& from, std::size_t i) {
    OutputDescription to;
    add(from, snapshot_ == nullptr ? nullptr : &snapshot_->outputs[i], to);
    for (const InputPortBase* reader : from.readers()) to.peers.push_back(joined(*reader));
    if (snapshot_ != nullptr) to.counters = snapshot_->output_counters[i];
    description_.outputs.push_back(std::move(to));
  }

  void add(const OperationBase& from) {
    OperationDescription to;
    to.name = from.name();
    to.doc = from.doc();
    const Signature& signature = from.signature();
    to.signature = signature.text();
    to.arguments = arguments_of(signature);
    if (signature.result != nullptr) to.result = signature.result->name;
    to.own_thread = from.runs_in_own_thread();
    to.command = from.is_command();
    to.by_operator = from.is_by_operator();
    description_.operations.push_back(std::move(to));
  }

  void add(const EventBase& from, std::size_t i) {
    EventDescription to;
    to.name = from.name();
    to.doc = from.doc();
    to.signature = from.signature().text();
    to.arguments = arguments_of(from.signature());
    if (snapshot_ != nullptr) to.raised = snapshot_->raised[i];
    for (const EventHandlerBase* handler : from.subscribers()) {
      to.subscribers.push_back(handler->owner().name());
    }
    description_.events.push_back(std::move(to));
  }

  /// @param now  nullptr: not known
  RequirementDescription& add(const Requirement& from, const Signature& signature,
                              const internal::Snapshot::Requirement* now) {
    RequirementDescription& to = description_.requirements.emplace_back();
    to.name = from.name();
    to.doc = from.doc();
    to.signature = signature.text();
    to.optional = from.is_optional();
    if (now == nullptr) return to;
    to.wanted = now->wanted;
    to.peer = now->peer;
    to.not_taken = now->not_taken;
    return to;
  }

  void add(const OperationCallerBase& from, std::size_t i) {
    const auto* const now = snapshot_ == nullptr ? nullptr : &snapshot_->callers[i];
    RequirementDescription& to = add(from, from.signature(), now);
    to.command = from.needs_command();
    if (from.target() != nullptr) to.bound_to = joined(*from.target());
  }

  void add(const EventHandlerBase& from, std::size_t i) {
    const auto* const now = snapshot_ == nullptr ? nullptr : &snapshot_->handlers[i];
    RequirementDescription& to = add(from, from.signature(), now);
    to.event = true;
    if (from.source() != nullptr) to.bound_to = joined(*from.source());
  }

  void add(const StateMachine& from, std::size_t i) {
    MachineDescription to;
    to.name = from.name();
    to.doc = from.doc();
    const MachineTable& table = from.table();
    for (std::size_t state = 0; state < table.states.size(); ++state) {
      to.states.push_back({table.path(static_cast<int>(state)), table.states[state].doc,
                           table.states[state].final});
    }
    for (const MachineTransition& transition : table.transitions) {
      to.transitions.push_back(table.text(transition));
    }
    to.triggers = table.triggers;
    to.problems = from.problems();
    if (snapshot_ != nullptr) to.current = snapshot_->machines[i];
    description_.machines.push_back(std::move(to));
  }

  const internal::Snapshot* snapshot_;
  bool with_values_;
  ComponentDescription description_;
};

}  // namespace

std::string doc_with_values(const std::string& doc, const std::vector<std::string>& values) {
  if (values.empty()) return doc;
  return doc + (doc.empty() ? "(" : " (") + base::alternatives(values) + ")";
}

ComponentDescription internal::describe_interface(const Component& component,
                                                  const Snapshot* snapshot, Values values) {
  return Describer(snapshot, values).describe(component::interface_of(component));
}

ComponentDescription describe(const Component& component, std::string model, Values values) {
  internal::Snapshot snapshot(component);
  snapshot.take(base::Time{});
  ComponentDescription description = internal::describe_interface(component, &snapshot, values);
  description.model = std::move(model);
  description.name = component.name();
  description.state = component.state();
  description.reason = component.reason();
  if (const auto* caller = dynamic_cast<const component::CallsByName*>(&component)) {
    description.most_calls = caller->most_calls();
  }
  return description;
}

}  // namespace armature::inspect
