// SPDX-License-Identifier: Apache-2.0
#include "python/native/model.hpp"

#include <array>
#include <utility>

#include "armature/inspect/view.hpp"
#include "python/native/python_component.hpp"

namespace armature::python {
namespace {

constexpr std::size_t kSlots = 64;

/// Each has a function that makes components of its model. They stay until the process ends: a
/// registry may still have the function.
using Slots = std::array<std::shared_ptr<const Model>, kSlots>;

Slots& slots() {
  static Slots& all = *new Slots;
  return all;
}

template <std::size_t I>
std::unique_ptr<component::Component> make_in_slot(std::string name) {
  return std::make_unique<PythonComponent>(std::move(name), slots()[I]);
}

constexpr auto kMakers = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<component::Registry::Make, sizeof...(I)>{&make_in_slot<I>...};
}
(std::make_index_sequence<kSlots>{});

component::Registry::Make put_in_slot(const std::shared_ptr<const Model>& model) {
  for (std::size_t i = 0; i < kSlots; ++i) {
    auto& slot = slots()[i];
    if (slot != nullptr && slot->name != model->name) continue;
    slot = model;
    return kMakers[i];
  }
  throw inspect::Refusal("a process has at most " + std::to_string(kSlots) +
                         " models in Python: start another one");
}

}  // namespace

void add_models(const std::vector<std::shared_ptr<const Model>>& models,
                component::Registry& registry) {
  for (const auto& model : models) {
    const auto added = registry.add({model->name, model->doc, "python", put_in_slot(model)});
    if (!added) throw inspect::Refusal(added.error());
  }
}

}  // namespace armature::python
