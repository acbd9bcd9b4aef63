// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "armature/inspect/describe.hpp"
#include "armature/inspect/internal/description_json.hpp"
#include "armature/inspect/internal/model_description.hpp"
#include "armature/inspect/model_catalogue.hpp"

namespace armature::inspect {
namespace {

using internal::Json;

Json json_of(const component::Registry::Model& model, const ComponentDescription& description) {
  Json further = Json::array();
  for (const auto& one : model.further_names) {
    further.push_back({{"name", one.name}, {"number", one.property}});
  }
  Json json = {{"name", model.name},       {"further_names", std::move(further)},
               {"library", model.library}, {"granularity", types::name_of(model.granularity)},
               {"face", model.face},       {"doc", model.doc}};
  internal::add_members(description, "default", json);
  return json;
}

}  // namespace

base::Result<std::string> models_as_json(const component::Registry& registry,
                                         const std::vector<std::string>& names, int indent) {
  Json models = Json::array();
  for (const std::string& name : names.empty() ? registry.names() : names) {
    const auto model = internal::find_model(registry, name);
    if (!model) return base::Error{model.error()};
    const auto description = internal::describe_model(*model.value());
    if (!description) return base::Error{description.error()};
    models.push_back(json_of(*model.value(), description.value()));
  }
  return internal::text_of(models, indent);
}

}  // namespace armature::inspect
