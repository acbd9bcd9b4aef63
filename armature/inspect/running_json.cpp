// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/running_json.hpp"

#include "armature/inspect/internal/description_json.hpp"

namespace armature::inspect {
namespace {

using internal::Json;

/// An input that leads nowhere while its component runs may stay so.
void allow_open_inputs(ComponentDescription& description) {
  for (InputDescription& input : description.inputs) input.may_stay_open = !input.connected();
}

Json running_components(View& view) {
  Json all = Json::array();
  for (const std::string& name : view.component_names()) {
    ComponentDescription description = view.describe(name, Values::kIncluded);
    allow_open_inputs(description);
    Json json = {{"name", description.name},
                 {"model", description.model},
                 {"thread", description.thread},
                 {"activity", {{"kind", description.activity}}}};
    internal::add_members(description, "value", json);
    all.push_back(std::move(json));
  }
  return all;
}

Json running_connections(View& view) {
  Json all = Json::array();
  for (const Connection& one : view.connections()) all.push_back(internal::connection_json(one));
  return all;
}

Json running_threads(const ApplicationStatus& status, const Json& components) {
  Json all = Json::array();
  for (const ThreadStatus& thread : status.threads) {
    Json order = Json::array();
    for (const Json& component : components) {
      if (component["thread"] == thread.name) order.push_back(component["name"]);
    }
    all.push_back({{"name", thread.name},
                   {"activity", {{"kind", thread.activity}}},
                   {"order", std::move(order)}});
  }
  return all;
}

}  // namespace

std::string running_as_json(View& view, const std::string& where) {
  const ApplicationStatus status = view.status();
  const Json components = running_components(view);
  const Json json = {{"format", internal::kCheckedFormat},
                     {"file", where},
                     {"application", status.name},
                     {"ok", true},
                     {"errors", 0},
                     {"diagnostics", Json::array()},
                     {"components", components},
                     {"connections", running_connections(view)},
                     {"threads", running_threads(status, components)},
                     {"modes", Json::array()}};
  return internal::text_of(json, -1);
}

}  // namespace armature::inspect
