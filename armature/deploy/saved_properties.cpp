// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/saved_properties.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/component/interface.hpp"
#include "armature/component/properties/keeping.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/document/property_value.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/orocos/property_file.hpp"
#include "armature/platform/file.hpp"

namespace armature::deploy {

using namespace document;
namespace {

/// A component with `autosave` and its file.
struct Saved {
  component::Component& component;
  const PropertyFile& file;
  component::Keeping* keeping;  ///< nullptr: it has nothing but settings
};

std::vector<Saved> saved_in(const Document& document, const exec::Blueprint& blueprint) {
  const auto saves = [](const Component& written) {
    return written.autosave && !written.property_files.empty();
  };
  if (std::ranges::none_of(document.components, saves)) return {};
  std::unordered_map<std::string_view, component::Component*> made;
  for (const exec::ComponentEntry& entry : blueprint.components) {
    made.emplace(entry.component->name(), entry.component.get());
  }
  std::vector<Saved> all;
  for (const Component& written : document.components) {
    const auto found = made.find(written.name);
    if (!saves(written) || found == made.end()) continue;
    auto* const keeps = dynamic_cast<component::Keeps*>(found->second);
    all.push_back({*found->second, written.property_files.back(),
                   keeps == nullptr ? nullptr : &keeps->keeping()});
  }
  return all;
}

component::KeepingMoment moment_of(const Document& document, const Saved& saved) {
  return {document.application + "/" + saved.component.name(),
          std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now())};
}

std::vector<Property> persistent_properties(const component::Component& component) {
  std::vector<Property> properties;
  for (const component::PropertyBase* property : component::interface_of(component).properties) {
    if (!property->persistent()) continue;
    properties.push_back({std::string(property->name()),
                          write_value(property->type(), property->data()),
                          std::string(property->doc()),
                          {}});
  }
  return properties;
}

void write(const Document& document, const Saved& saved, base::Diagnostics& diagnostics) {
  const base::Result<void> written =
      platform::write_file(path_from(document, saved.file.path),
                           orocos::write_cpf(persistent_properties(saved.component)));
  if (written) return;
  diagnostics.error(saved.file.where, "the properties of " + in_quotes(saved.component.name()) +
                                          " were not saved: " + written.error());
}

}  // namespace

void take_kept(const Document& document, const exec::Blueprint& blueprint,
               base::Diagnostics& diagnostics) {
  for (const Saved& saved : saved_in(document, blueprint)) {
    if (saved.keeping == nullptr) continue;
    saved.keeping->take(moment_of(document, saved), saved.file.where, diagnostics);
  }
}

void begin_kept(const Document& document, const exec::Blueprint& blueprint,
                base::Diagnostics& diagnostics) {
  for (const Saved& saved : saved_in(document, blueprint)) {
    if (saved.keeping == nullptr) continue;
    saved.keeping->begin(moment_of(document, saved));
    write(document, saved, diagnostics);
  }
}

void give_back_kept(const Document& document, const exec::Blueprint& blueprint,
                    base::Diagnostics& diagnostics) {
  for (const Saved& saved : saved_in(document, blueprint)) {
    if (saved.keeping == nullptr) continue;
    saved.keeping->give_back();
    write(document, saved, diagnostics);
  }
}

void save_properties(const Document& document, const exec::Blueprint& blueprint,
                     base::Diagnostics& diagnostics) {
  for (const Saved& saved : saved_in(document, blueprint)) {
    if (saved.keeping != nullptr) {
      const std::string why = saved.keeping->end(moment_of(document, saved));
      if (!why.empty()) {
        diagnostics.warning(saved.file.where,
                            in_quotes(saved.component.name()) + " keeps no position: " + why,
                            "the next run begins at InitialPos");
      }
    }
    write(document, saved, diagnostics);
  }
}

}  // namespace armature::deploy
