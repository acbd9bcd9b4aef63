// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/set_value.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_text;
using document::Value;

/// The first file, in the order in which their words count, that names the library.
std::pair<const SourceText*, const Node*> find_library(const std::string& name,
                                                       const SourceMap& map) {
  for (const auto& file : map.files()) {
    for (const Node* item : items_of(find_value(file->root(), "libraries"))) {
      if (item->text == name) return {file.get(), item};
    }
  }
  return {nullptr, nullptr};
}

}  // namespace

void draft(const AddParameter& add, Workshop& shop) {
  const std::optional<Value> value = value_of(add.value, "parameter '" + add.name + "'", shop);
  const SourceText& file = shop.file_for_new();
  if (!value) return;
  if (document::find(shop.document().parameters, add.name) != nullptr) {
    return shop.refuse("parameter '" + add.name + "' is there already", "set changes it");
  }
  shop.add_to_section(file, "parameters", add.name, *value, 0);
  shop.expect([&before = shop.before(), add](const State& after, base::Diagnostics&) {
    Document expected = before.document;
    const auto* found = document::find(after.document.parameters, add.name);
    if (found != nullptr) expected.parameters.push_back(*found);
    return expected;
  });
}

void draft(const AddLibrary& add, Workshop& shop) {
  const SourceText& file = shop.file_for_new();
  if (const auto [there, item] = find_library(add.name, shop.map()); there != nullptr) {
    return shop.refuse(there->place_of(*item), "library '" + add.name + "' is there already");
  }
  shop.add_item_to_section(file, "libraries", make_text(add.name));
  shop.expect([&before = shop.before(), add](const State&, base::Diagnostics&) {
    Document expected = before.document;
    expected.libraries.push_back({add.name, {}});
    return expected;
  });
}

void draft(const RemoveLibrary& remove, Workshop& shop) {
  const auto [file, item] = find_library(remove.name, shop.map());
  if (file == nullptr) {
    std::vector<std::string> known;
    for (const auto& library : shop.document().libraries) known.push_back(library.name);
    return shop.refuse("unknown library '" + remove.name + "'",
                       base::suggestion(remove.name, known));
  }
  if (!shop.require(*file, *item, "library '" + remove.name + "'")) return;
  const Node* list = find_value(file->root(), "libraries");
  if (list == item) {
    shop.layout(*file).remove(*find_key(file->root(), "libraries"));
  } else {
    shop.layout(*file).remove(*item);
  }
  shop.expect([&before = shop.before(), remove](const State&, base::Diagnostics&) {
    Document expected = before.document;
    std::erase_if(expected.libraries, [&](const auto& one) { return one.name == remove.name; });
    return expected;
  });
}

}  // namespace armature::edit::internal
