// SPDX-License-Identifier: Apache-2.0
#include "python/native/model.hpp"

#include <array>
#include <utility>

#include "armature/inspect/view.hpp"
#include "python/native/python_component.hpp"

namespace armature::python {
namespace {

constexpr std::size_t kSlots = 64;

thread_local const ModelsOfLoad::Models* loading = nullptr;

template <std::size_t I>
std::unique_ptr<component::Component> make_in_slot(std::string name) {
  if (loading == nullptr || I >= loading->size()) {
    throw inspect::Refusal("components in Python are made while their deployment is loaded");
  }
  return std::make_unique<PythonComponent>(std::move(name), (*loading)[I]);
}

constexpr auto kMakers = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<component::Registry::Make, sizeof...(I)>{&make_in_slot<I>...};
}
(std::make_index_sequence<kSlots>{});

}  // namespace

ModelsOfLoad::ModelsOfLoad(const Models& models)
    : models_(models), outer_(std::exchange(loading, &models)) {}

ModelsOfLoad::~ModelsOfLoad() { loading = outer_; }

void ModelsOfLoad::add_to(component::Registry& registry) const {
  if (models_.size() > kSlots) {
    throw inspect::Refusal("a deployment has at most " + std::to_string(kSlots) +
                           " models in Python, found " + std::to_string(models_.size()));
  }
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const Model& model = *models_[i];
    const auto added = registry.add({model.name, model.doc, "python", kMakers[i]});
    if (!added) throw inspect::Refusal(added.error());
  }
}

}  // namespace armature::python
