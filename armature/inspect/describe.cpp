// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/describe.hpp"

#include "armature/component/events/event.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/port_array.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/component/states/state_machine.hpp"
#include "armature/types/elements.hpp"

namespace armature::inspect {

using namespace component;
namespace {

std::string joined(const Component& component, std::string_view item) {
  return component.name() + "." + std::string(item);
}

PropertyDescription describe_property(const PropertyBase& property, Values values) {
  PropertyDescription description;
  description.name = property.name();
  description.doc = property.doc();
  description.type = property.type().name;
  description.values = types::enumerator_names(property.type());
  description.unit = property.unit();
  description.range = property.limits();
  description.persistent = property.persistent();
  description.changeable_while_running = property.changeable();
  description.mandatory = property.is_mandatory();
  description.was_set = property.was_set();
  if (values == Values::kIncluded) {
    description.value = types::to_text(property.type(), property.data());
  }
  return description;
}

void describe_port(const PortBase& port, Values values, PortDescription& description) {
  description.name = port.name();
  description.doc = port.doc();
  description.type = port.type().name;
  description.values = types::enumerator_names(port.type());
  description.unit = port.unit();
  if (port.declared_size().declared()) description.size = port.declared_size().value();
  description.sequence = port.current_sequence();
  if (values == Values::kIncluded) {
    description.value = types::to_text(port.type(), port.current());
  }
}

InputDescription describe_input(const InputPortBase& port, Values values) {
  InputDescription description;
  describe_port(port, values, description);
  for (const OutputPortBase* writer : port.writers()) {
    description.peers.push_back(joined(writer->owner(), writer->name()));
  }
  description.triggers = port.triggers();
  description.may_stay_open = port.stays_open();
  description.allows_fan_in = port.allows_fan_in();
  description.max_age = port.max_age();
  description.when_stale = port.stale_reaction();
  description.when_lost = port.lost_reaction();
  description.counters = port.counters();
  return description;
}

OutputDescription describe_output(const OutputPortBase& port, Values values) {
  OutputDescription description;
  describe_port(port, values, description);
  for (const InputPortBase* reader : port.readers()) {
    description.peers.push_back(joined(reader->owner(), reader->name()));
  }
  description.counters = port.counters();
  return description;
}

OperationDescription describe_operation(const OperationBase& operation) {
  return {std::string(operation.name()), std::string(operation.doc()),
          operation.signature().text(),  operation.runs_in_own_thread(),
          operation.is_command(),        operation.is_by_operator()};
}

EventDescription describe_event(const EventBase& event) {
  EventDescription description{std::string(event.name()),
                               std::string(event.doc()),
                               event.signature().text(),
                               event.raised(),
                               {}};
  for (const EventHandlerBase* handler : event.subscribers()) {
    description.subscribers.push_back(handler->owner().name());
  }
  return description;
}

RequirementDescription describe_requirement(const Requirement& requirement,
                                            const Signature& signature) {
  RequirementDescription description;
  description.name = requirement.name();
  description.doc = requirement.doc();
  description.signature = signature.text();
  description.optional = requirement.is_optional();
  description.wanted = requirement.wanted();
  description.peer = requirement.peer_name();
  return description;
}

RequirementDescription describe_caller(const OperationCallerBase& caller) {
  RequirementDescription description = describe_requirement(caller, caller.signature());
  description.command = caller.needs_command();
  description.not_taken = caller.refused();
  if (const OperationBase* target = caller.target(); target != nullptr) {
    description.bound_to = joined(target->owner(), target->name());
  }
  return description;
}

RequirementDescription describe_handler(const EventHandlerBase& handler) {
  RequirementDescription description = describe_requirement(handler, handler.signature());
  description.event = true;
  description.not_taken = handler.dropped();
  if (const EventBase* source = handler.source(); source != nullptr) {
    description.bound_to = joined(source->owner(), source->name());
  }
  return description;
}

MachineDescription describe_machine(const StateMachine& machine) {
  MachineDescription description;
  description.name = machine.name();
  description.doc = machine.doc();
  const MachineTable& table = machine.table();
  for (std::size_t i = 0; i < table.states.size(); ++i) {
    description.states.push_back(
        {table.path(static_cast<int>(i)), table.states[i].doc, table.states[i].final});
  }
  for (const MachineTransition& transition : table.transitions) {
    description.transitions.push_back(table.text(transition));
  }
  description.triggers = table.triggers;
  description.problems = machine.problems();
  description.current = machine.path();
  return description;
}

}  // namespace

ComponentDescription describe(const Component& component, std::string model, Values values) {
  ComponentDescription description;
  description.model = std::move(model);
  description.name = component.name();
  description.state = component.state();
  description.reason = component.reason();
  const Interface& interface = component.interface();
  for (const auto* each : interface.properties) {
    description.properties.push_back(describe_property(*each, values));
  }
  for (const auto* each : interface.inputs) {
    description.inputs.push_back(describe_input(*each, values));
  }
  for (const auto* each : interface.outputs) {
    description.outputs.push_back(describe_output(*each, values));
  }
  for (const auto* each : interface.port_arrays) {
    description.port_arrays.push_back(
        {std::string(each->name()), std::string(each->count().name())});
  }
  for (const auto* each : interface.operations) {
    description.operations.push_back(describe_operation(*each));
  }
  for (const auto* each : interface.events) description.events.push_back(describe_event(*each));
  for (const auto* each : interface.callers) {
    description.requirements.push_back(describe_caller(*each));
  }
  for (const auto* each : interface.handlers) {
    description.requirements.push_back(describe_handler(*each));
  }
  for (const auto* each : interface.machines) {
    description.machines.push_back(describe_machine(*each));
  }
  return description;
}

}  // namespace armature::inspect
