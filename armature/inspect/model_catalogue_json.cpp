// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <nlohmann/json.hpp>

#include "armature/inspect/describe.hpp"
#include "armature/inspect/internal/model_description.hpp"
#include "armature/inspect/model_catalogue.hpp"

namespace armature::inspect {
namespace {

using Json = nlohmann::ordered_json;

/// JSON knows no infinity: such a bound is left open.
Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const PropertyDescription& property) {
  Json json = {{"name", property.name},
               {"type", property.type},
               {"unit", property.unit},
               {"doc", property.doc},
               {"default", property.value}};
  if (!property.values.empty()) json["values"] = property.values;
  if (property.range) json["range"] = {bound(property.range->low), bound(property.range->high)};
  json["persistent"] = property.persistent;
  json["mandatory"] = property.mandatory;
  json["changeable_while_running"] = property.changeable_while_running;
  return json;
}

Json port(const PortDescription& port) {
  Json json = {{"name", port.name}, {"type", port.type}, {"unit", port.unit}, {"doc", port.doc}};
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

Json json_of(const OperationDescription& operation) {
  return {{"name", operation.name},       {"signature", operation.signature},
          {"doc", operation.doc},         {"own_thread", operation.own_thread},
          {"command", operation.command}, {"by_operator", operation.by_operator}};
}

Json json_of(const EventDescription& event) {
  return {{"name", event.name}, {"signature", event.signature}, {"doc", event.doc}};
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

template <typename Items>
Json list(const Items& items) {
  Json json = Json::array();
  for (const auto& item : items) json.push_back(json_of(item));
  return json;
}

Json json_of(const component::Registry::Model& model, const ComponentDescription& description) {
  Json further = Json::array();
  for (const auto& one : model.further_names) {
    further.push_back({{"name", one.name}, {"number", one.property}});
  }
  return {{"name", model.name},
          {"further_names", std::move(further)},
          {"library", model.library},
          {"doc", model.doc},
          {"properties", list(description.properties)},
          {"inputs", list(description.inputs)},
          {"outputs", list(description.outputs)},
          {"port_arrays", list(description.port_arrays)},
          {"operations", list(description.operations)},
          {"events", list(description.events)},
          {"requirements", list(description.requirements)},
          {"state_machines", list(description.machines)}};
}

}  // namespace

base::Result<std::string> models_as_json(const component::Registry& registry,
                                         const std::vector<std::string>& names) {
  Json models = Json::array();
  for (const std::string& name : names.empty() ? registry.names() : names) {
    const auto model = internal::find_model(registry, name);
    if (!model) return base::Error{model.error()};
    const auto description = internal::describe_model(*model.value());
    if (!description) return base::Error{description.error()};
    models.push_back(json_of(*model.value(), description.value()));
  }
  // Texts of a library need not be UTF-8; JSON must be.
  return models.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace armature::inspect
