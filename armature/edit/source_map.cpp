// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/source_map.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "armature/document/ranges.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/with_parameters.hpp"

namespace armature::edit {
namespace {

using document::place_text;
using internal::with_parameters;

bool is_true(const Node* value) { return value != nullptr && value->text == "true"; }

/// The names that a key with a range stands for.
std::vector<std::string> names_in(const std::string& key) {
  base::Diagnostics ignored;  // the document has no errors
  const auto found = document::find_range(key, {}, ignored);
  if (!found) return {key};
  std::vector<std::string> names;
  for (int number = found->range.first; number <= found->range.last; ++number) {
    std::string name = key;
    name.replace(found->begin, found->end - found->begin, std::to_string(number));
    names.push_back(document::replace_number(name, number, {}, ignored));
  }
  return names;
}

/// Full names of what an entry changes.
std::vector<std::string> changed_names(const std::string& key, const std::string& composite,
                                       const document::Document& document) {
  if (composite.empty()) return names_in(with_parameters(key, document.parameters));
  std::vector<std::string> names;
  for (const document::Composite& instance : document.composites) {
    if (instance.model != composite) continue;
    for (const std::string& name : names_in(with_parameters(key, instance.parameters))) {
      names.push_back(instance.name + "." + name);
    }
  }
  return names;
}

}  // namespace

std::string normal_path(const std::string& path) {
  return std::filesystem::path(path).lexically_normal().string();
}

bool is_orocos_file(const std::string& path) {
  const std::filesystem::path extension = std::filesystem::path(path).extension();
  return extension == ".xml" || extension == ".cpf";
}

SourceMap::SourceMap(const std::string& path, const deploy::FileReader& read,
                     const document::Document& document, base::Diagnostics& diagnostics) {
  for (const document::Component& one : document.components) {
    made_at_[place_text(one.where)].push_back(one.name);
  }
  for (const document::Composite& one : document.composites) {
    made_at_[place_text(one.where)].push_back(one.name);
  }
  add_file(normal_path(path), read, document, diagnostics);
}

void SourceMap::add_file(const std::string& path, const deploy::FileReader& read,
                         const document::Document& document, base::Diagnostics& diagnostics) {
  if (std::find(seen_.begin(), seen_.end(), path) != seen_.end()) return;
  seen_.push_back(path);
  if (is_orocos_file(path)) return;  // and what it includes: nothing in them can be edited
  const base::Result<std::string> text = read(path);
  if (!text) return diagnostics.error({path, 0, 0}, text.error());
  auto file = std::make_unique<SourceText>(path, text.value(), diagnostics);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (const Node* included : items_of(find_value(file->root(), "include"))) {
    add_file(normal_path((folder / included->text).string()), read, document, diagnostics);
  }
  const Node* root = file->root();
  add_components(*file, find_value(root, "components"), {}, document);
  add_connections(*file, find_value(root, "connections"), {});
  if (const Node* composites = find_value(root, "composites"); composites != nullptr) {
    for (std::size_t i = 0; i + 1 < composites->children.size(); i += 2) {
      const std::string& name = composites->children[i]->text;
      const Node* definition = composites->children[i + 1];
      add_components(*file, find_value(definition, "components"), name, document);
      add_connections(*file, find_value(definition, "connections"), name);
    }
  }
  files_.push_back(std::move(file));
}

void SourceMap::add_components(const SourceText& file, const Node* components,
                               const std::string& composite, const document::Document& document) {
  if (components == nullptr || components->kind != Node::Kind::kMap) return;
  for (std::size_t i = 0; i + 1 < components->children.size(); i += 2) {
    Entry entry{&file, components->children[i], components->children[i + 1], composite, {}, false};
    entry.changes =
        is_true(find_value(entry.value, "override")) || is_true(find_value(entry.value, "remove"));
    const auto made = made_at_.find(place_text(file.place_of(*entry.key)));
    if (entry.changes) {
      entry.names = changed_names(entry.key->text, composite, document);
    } else if (made != made_at_.end()) {
      entry.names = made->second;
    }
    entries_.push_back(std::move(entry));
  }
}

void SourceMap::add_connections(const SourceText& file, const Node* connections,
                                const std::string& composite) {
  for (const Node* item : items_of(connections)) {
    connection_places_.emplace(place_text(file.place_of(*item)), connections_.size());
    connections_.push_back({&file, item, composite});
  }
}

const SourceText* SourceMap::file(std::string_view path) const {
  const std::string wanted = normal_path(std::string(path));
  const auto found = std::find_if(files_.begin(), files_.end(),
                                  [&](const auto& one) { return one->path() == wanted; });
  return found == files_.end() ? nullptr : found->get();
}

std::vector<const Entry*> SourceMap::entries_of(std::string_view name) const {
  std::vector<const Entry*> found;
  for (const bool changes : {false, true}) {
    for (const Entry& entry : entries_) {
      if (entry.changes != changes) continue;
      if (std::find(entry.names.begin(), entry.names.end(), name) == entry.names.end()) continue;
      found.push_back(&entry);
    }
  }
  return found;
}

const ConnectionEntry* SourceMap::connection_at(const base::Location& where) const {
  const auto found = connection_places_.find(place_text(where));
  return found == connection_places_.end() ? nullptr : &connections_[found->second];
}

const ConnectionEntry* SourceMap::entry_of(const document::Connection& connection) const {
  return connection_at(connection.where);
}

const ConnectionEntry* SourceMap::entry_of(const document::NamedConnection& connection) const {
  return connection_at(connection.where);
}

}  // namespace armature::edit
