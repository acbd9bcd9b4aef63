// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/workshop.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "armature/document/value_tree.hpp"

namespace armature::edit::internal {

using document::make_list;
using document::make_map;
using document::Value;

namespace {

/// The last of a file's sections that usually stand before that one; empty: none.
std::string_view section_before(std::string_view section, const Node& root) {
  constexpr std::array<std::string_view, 7> kOrder = {
      "include", "application", "libraries", "parameters", "components", "connections", "modes"};
  std::string_view before;
  for (const std::string_view one : kOrder) {
    if (one == section) return before;
    if (find_key(&root, one) != nullptr) before = one;
  }
  return {};
}

}  // namespace

State read_state(const std::string& file, const deploy::FileReader& read,
                 const document::Limits& limits, base::Diagnostics& diagnostics) {
  State state{file, {}, limits, {}, nullptr};
  deploy::LoadOptions options;
  options.read = [&](const std::string& path) {
    base::Result<std::string> text = read(path);
    if (text) state.texts[path] = text.value();
    return text;
  };
  options.limits = limits;
  base::Diagnostics found;
  state.document = deploy::load_document(file, options, found);
  if (found.ok()) {
    state.map = std::make_unique<SourceMap>(file, options.read, state.document, found);
  }
  for (const base::Diagnostic& one : found.all()) {
    if (one.severity == base::Severity::kError) diagnostics.add(one);
  }
  return state;
}

document::Document State::with(const std::vector<std::string>& settings) const {
  deploy::LoadOptions options;
  options.read = [this](const std::string& path) -> base::Result<std::string> {
    const auto found = texts.find(path);
    if (found == texts.end()) return base::Error{"file '" + path + "' does not exist"};
    return found->second;
  };
  options.limits = limits;
  options.overrides = settings;
  base::Diagnostics found;
  document::Document result = deploy::load_document(file, options, found);
  return found.ok() ? std::move(result) : document::Document{};
}

std::string refusal_of(const Change& change, const std::string& reason) {
  return to_text(change) + " is refused: " + reason;
}

bool Workshop::may_change(const SourceText& file) const {
  if (&file == &map().main()) return true;
  return std::any_of(edit_.files.begin(), edit_.files.end(), [&](const std::string& allowed) {
    return normal_path(allowed) == file.path();
  });
}

bool Workshop::require(const SourceText& file, const Node& node, const std::string& what) {
  if (may_change(file)) return true;
  refuse(file.place_of(node), what + " stands in " + file.path(),
         "change that file with --in " + file.path() +
             (overrides() ? "" : ", or override it here with --override"));
  return false;
}

const SourceText& Workshop::file_for_new() const {
  return edit_.files.empty() ? map().main() : *map().file(edit_.files.front());
}

Layout& Workshop::layout(const SourceText& file) {
  return layouts_.try_emplace(&file, file).first->second;
}

void Workshop::add_section(const SourceText& file, const std::string& section, const Value& content,
                           int levels) {
  const Node* root = file.root();
  if (root == nullptr || root->is_empty()) {
    layout(file).begin_file(section, content, levels);
  } else if (root->kind != Node::Kind::kMap) {
    refuse(file.path() + " is not a map of sections");
  } else if (const Node* value = find_value(root, section); value == nullptr) {
    layout(file).add_entry(*root, section, content, levels, section_before(section, *root));
  } else {
    layout(file).fill(*value, content, levels);
  }
}

void Workshop::add_to_section(const SourceText& file, const std::string& section,
                              const std::string& key, const Value& value, int levels) {
  const Node* map = find_value(file.root(), section);
  if (map != nullptr && map->kind == Node::Kind::kMap) {
    layout(file).add_entry(*map, key, value, levels);
  } else if (map != nullptr && map->kind == Node::Kind::kAlias) {
    refuse(file.place_of(*map), section + " is an alias", "write it out there first");
  } else {
    Value content = make_map();
    content.entries.push_back({key, value, {}, {}});
    add_section(file, section, content, 1 + levels);
  }
}

void Workshop::add_item_to_section(const SourceText& file, const std::string& section,
                                   const Value& item) {
  const Node* list = find_value(file.root(), section);
  if (list != nullptr && list->kind == Node::Kind::kList) {
    layout(file).add_item(*list, item);
  } else if (list != nullptr && list->kind == Node::Kind::kAlias) {
    refuse(file.place_of(*list), section + " is an alias", "write it out there first");
  } else {
    Value content = make_list();
    const bool one = list != nullptr && !list->is_empty();
    if (one) content.items.push_back(document::make_text(list->text));
    content.items.push_back(item);
    add_section(file, section, content, section == "connections" ? 1 : 0);
  }
}

void Workshop::refuse(const base::Location& where, const std::string& reason,
                      const base::Hint& hint) {
  diagnostics_.error(where, refusal_of(edit_.change, reason), hint);
}

void Workshop::refuse(const std::string& reason, const base::Hint& hint) {
  refuse({before_.file, 0, 0}, reason, hint);
}

std::map<std::string, std::vector<Replacement>> Workshop::take() {
  std::map<std::string, std::vector<Replacement>> by_file;
  for (auto& [file, layout] : layouts_) {
    std::vector<Replacement> replacements = layout.take();
    if (!replacements.empty()) by_file[file->path()] = std::move(replacements);
  }
  return by_file;
}

}  // namespace armature::edit::internal
