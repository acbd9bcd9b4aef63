// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/internal/description_json.hpp"

#include <cmath>

#include "armature/inspect/describe.hpp"

namespace armature::inspect::internal {
namespace {

/// JSON knows no infinity: such a bound is left open.
Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const PropertyDescription& property, const char* value_key) {
  Json json = {{"name", property.name},
               {"type", property.type},
               {"unit", property.unit},
               {"doc", property.doc},
               {value_key, property.value}};
  if (!property.unit_property.empty()) json["unit_property"] = property.unit_property;
  if (!property.values.empty()) json["values"] = property.values;
  if (property.range) json["range"] = {bound(property.range->low), bound(property.range->high)};
  json["persistent"] = property.persistent;
  json["mandatory"] = property.mandatory;
  json["changeable_while_running"] = property.changeable_while_running;
  if (property.by_operator) json["by_operator"] = true;
  return json;
}

Json port(const PortDescription& port) {
  Json json = {{"name", port.name}, {"type", port.type}, {"unit", port.unit}, {"doc", port.doc}};
  if (!port.unit_property.empty()) json["unit_property"] = port.unit_property;
  if (!port.values.empty()) json["values"] = port.values;
  if (port.size) json["size"] = *port.size;
  return json;
}

Json json_of(const InputDescription& input) {
  Json json = port(input);
  json["triggers"] = input.triggers;
  json["may_stay_open"] = input.may_stay_open;
  json["fan_in"] = input.allows_fan_in;
  if (input.max_age > base::Duration::zero()) {
    json["max_age_ns"] = input.max_age.count();
    json["on_old"] = component::name_of(input.when_stale);
  }
  json["on_lost"] = component::name_of(input.when_lost);
  return json;
}

Json json_of(const OutputDescription& output) { return port(output); }

Json json_of(const PortArrayDescription& array) {
  return {{"name", array.name}, {"count", array.count}};
}

Json arguments(const std::vector<ArgumentDescription>& all) {
  Json json = Json::array();
  for (const ArgumentDescription& one : all)
    json.push_back({{"name", one.name}, {"type", one.type}});
  return json;
}

Json json_of(const OperationDescription& operation) {
  return {{"name", operation.name},
          {"signature", operation.signature},
          {"arguments", arguments(operation.arguments)},
          {"result", operation.result},
          {"doc", operation.doc},
          {"own_thread", operation.own_thread},
          {"command", operation.command},
          {"by_operator", operation.by_operator}};
}

Json json_of(const EventDescription& event) {
  return {{"name", event.name},
          {"signature", event.signature},
          {"arguments", arguments(event.arguments)},
          {"doc", event.doc}};
}

Json json_of(const RequirementDescription& requirement) {
  const char* const kind = requirement.event     ? "event"
                           : requirement.command ? "command"
                                                 : "operation";
  return {{"name", requirement.name},
          {"kind", kind},
          {"signature", requirement.signature},
          {"doc", requirement.doc},
          {"optional", requirement.optional}};
}

Json json_of(const MachineDescription& machine) {
  Json states = Json::array();
  for (const auto& state : machine.states) {
    states.push_back({{"path", state.path}, {"doc", state.doc}, {"final", state.final}});
  }
  return {{"name", machine.name},
          {"doc", machine.doc},
          {"states", std::move(states)},
          {"transitions", machine.transitions}};
}

Json json_of(const FieldDescription& field) {
  Json json = {{"structure", field.structure},
               {"name", field.name},
               {"type", field.type},
               {"unit", field.unit},
               {"doc", field.doc}};
  if (!field.values.empty()) json["values"] = field.values;
  return json;
}

Json list(const auto& items, const auto&... how) {
  Json json = Json::array();
  for (const auto& item : items) json.push_back(json_of(item, how...));
  return json;
}

}  // namespace

Json connection_json(const Connection& connection) {
  Json json = {{"kind", connection.kind}, {"from", connection.from}, {"to", connection.to}};
  if (connection.kind == "data") {
    json["triggers"] = connection.triggers;
    json["delayed"] = connection.delayed;
  }
  json["crosses_threads"] = connection.crosses_threads;
  return json;
}

void add_members(const ComponentDescription& description, const char* value_key, Json& to) {
  to["properties"] = list(description.properties, value_key);
  to["inputs"] = list(description.inputs);
  to["outputs"] = list(description.outputs);
  to["port_arrays"] = list(description.port_arrays);
  to["operations"] = list(description.operations);
  to["events"] = list(description.events);
  to["requirements"] = list(description.requirements);
  to["state_machines"] = list(description.machines);
  to["fields"] = list(description.fields);
  if (description.most_calls > 0) to["most_calls"] = description.most_calls;
}

}  // namespace armature::inspect::internal
