// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/scalar_text.hpp"
#include "armature/edit/internal/workshop.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_text;

constexpr const char* kInclude = "include";

/// A file that another one includes, as that one names it.
struct Inclusion {
  const SourceText* file = nullptr;
  const Node* item = nullptr;
};

/// The inclusion in the deployment's own file, or else in another.
Inclusion find_inclusion(const std::string& name, const SourceMap& map) {
  const auto& files = map.files();
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    for (const Node* item : items_of(find_value((*file)->root(), kInclude))) {
      if (item->text == name) return {file->get(), item};
    }
  }
  return {};
}

std::vector<std::string> included_names(const SourceMap& map) {
  std::vector<std::string> names;
  for (const auto& file : map.files()) {
    for (const Node* item : items_of(find_value(file->root(), kInclude))) {
      names.push_back(item->text);
    }
  }
  return names;
}

/// What the larger of two documents may have that the smaller has not: what is of its other files.
class Additions {
 public:
  Additions(const State& smaller, const State& larger) {
    for (const auto& [path, text] : larger.texts) {
      if (!smaller.texts.contains(path)) files_.insert(path);
    }
    for (const auto& one : larger.document.composites) {
      if (files_.contains(one.where.file)) composites_.insert(one.name);
    }
  }

  /// A part of a new instance stands where its composite is defined, which may be in any file.
  bool has(const std::string& component, const base::Location& where) const {
    if (files_.contains(where.file)) return true;
    for (std::size_t dot = component.find('.'); dot != component.npos;
         dot = component.find('.', dot + 1)) {
      if (composites_.contains(component.substr(0, dot))) return true;
    }
    return false;
  }

 private:
  std::set<std::string> files_;
  std::set<std::string> composites_;
};

const std::string& owner_of(const document::Connection& one) { return one.from.component; }
template <typename Named>
const std::string& owner_of(const Named& one) {
  return one.name;
}

template <typename List>
List without(const List& list, const Additions& additions) {
  List rest;
  for (const auto& one : list) {
    if (!additions.has(owner_of(one), one.where)) rest.push_back(one);
  }
  return rest;
}

/// What differs between two deployments beside that. What is said of the application as a whole,
/// such as `on_fault`, is the other files' affair, too.
std::vector<std::string> other_differences(const State& smaller, const State& larger) {
  const Additions additions(smaller, larger);
  Document rest = smaller.document;
  rest.components = without(larger.document.components, additions);
  rest.connections = without(larger.document.connections, additions);
  rest.named_connections = without(larger.document.named_connections, additions);
  rest.composites = without(larger.document.composites, additions);
  rest.parameters = without(larger.document.parameters, additions);
  rest.modes = without(larger.document.modes, additions);
  return differences(smaller.document, rest);
}

/// @param adds  the document after the edit has a file more, else one less
Expectation expect_inclusion(const State& before, bool adds, const std::string& refusal) {
  return [&before, adds, refusal](const State& after, base::Diagnostics& diagnostics) {
    const auto others = adds ? other_differences(before, after) : other_differences(after, before);
    if (!others.empty()) {
      diagnostics.error({before.file, 0, 0},
                        refusal + "more than that would change: " + others.front());
    }
    return after.document;
  };
}

/// At the head of the file, below the comments there.
void write_inclusion(const SourceText& file, const std::string& name, Workshop& shop) {
  const Node* root = file.root();
  if (root == nullptr || root->is_empty()) {
    return shop.layout(file).begin_file(kInclude, make_text(name), 0);
  }
  const bool is_first = root->kind == Node::Kind::kMap && !root->flow && !root->children.empty() &&
                        find_key(root, kInclude) == nullptr;
  if (!is_first) return shop.add_item_to_section(file, kInclude, make_text(name));
  shop.layout(file).add_section_text(
      *root->children.front(), std::string(kInclude) + ": " + written_in_block(make_text(name)));
}

}  // namespace

void draft(const AddInclude& add, Workshop& shop) {
  const SourceText& file = shop.file_for_new();
  const Inclusion there = find_inclusion(add.file, shop.map());
  if (there.file == &file) {
    return shop.refuse(file.place_of(*there.item), "'" + add.file + "' is included already");
  }
  write_inclusion(file, add.file, shop);
  shop.expect(expect_inclusion(shop.before(), true, refusal_of(add, "")));
}

void draft(const RemoveInclude& remove, Workshop& shop) {
  const auto [file, item] = find_inclusion(remove.file, shop.map());
  if (file == nullptr) {
    return shop.refuse("no file includes '" + remove.file + "'",
                       base::suggestion(remove.file, included_names(shop.map())));
  }
  if (!shop.require(*file, *item, "the inclusion")) return;
  const Node* list = find_value(file->root(), kInclude);
  shop.layout(*file).remove(list == item ? *find_key(file->root(), kInclude) : *item);
  shop.expect(expect_inclusion(shop.before(), false, refusal_of(remove, "")));
}

}  // namespace armature::edit::internal
