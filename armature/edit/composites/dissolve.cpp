// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/connection_items.hpp"
#include "armature/edit/internal/definition_text.hpp"
#include "armature/edit/internal/element_text.hpp"
#include "armature/edit/internal/instance.hpp"
#include "armature/edit/internal/rewrite.hpp"
#include "armature/edit/internal/scalar_text.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_text;

/// Makes the text of one edit.
class Dissolving {
 public:
  Dissolving(const Instance& instance, Workshop& shop)
      : instance_(instance), file_(*instance.entry->file), shop_(shop) {}

  void draft() {
    write_parts();
    write_inner_connections();
    for (const ConnectionEntry& one : shop_.map().connections()) write_connection(one);
    for (const Mention& mention : mentions_in(shop_.map())) {
      if (!mention.in_connection && shop_.ok()) write(mention);
    }
    if (shop_.ok()) remove_definition();
  }

 private:
  /// The copy of a part or of a connection inside, at a column of the instance's file.
  std::string copy_of(const Node& first, std::size_t column) {
    CopyChanges changes;
    changes.comment_behind = true;
    changes.new_value = [&](const Node& scalar) {
      return instance_.without_parameters(scalar.text);
    };
    const SourceText& from = *instance_.definition_file;
    return moved_lines(copied_element(from, first, changes), from.column(first.begin), column);
  }

  void write_parts() {
    const std::size_t column = file_.column(instance_.entry->key->begin);
    const std::string margin = std::string(file_.end_of_line()) + std::string(column, ' ');
    std::vector<std::string> texts;
    for (const Entry* part : instance_.parts) {
      std::string text;
      for (const auto& comment : comments_above(*part->file, *part->key)) text += comment + margin;
      texts.push_back(text + copy_of(*part->key, column));
    }
    shop_.layout(file_).replace_element(*instance_.entry->key, texts);
  }

  void write_inner_connections() {
    if (instance_.connections.empty()) return;
    Layout& layout = shop_.layout(file_);
    const Node* list = find_value(file_.root(), "connections");
    const bool there = list != nullptr && list->kind == Node::Kind::kList;
    if (list != nullptr && !there) {
      return shop_.refuse(file_.place_of(*list), "connections is no list that can be added to");
    }
    const std::size_t column = there ? file_.column(list->begin) : layout.list_step();
    std::vector<std::string> texts;
    for (const ConnectionEntry* one : instance_.connections) {
      texts.push_back(copy_of(*one->item, column + 2));
    }
    if (there) return layout.add_item_texts(*list, texts);
    std::string section = "connections:";
    for (const std::string& text : texts) {
      section += std::string(file_.end_of_line()) + std::string(column, ' ') + "- " + text;
    }
    layout.add_entry_text(*file_.root(), section, "components");
  }

  /// An end of the instance is one of the part that it shows.
  std::string inside(const std::string& end, const SourceText& file, const Node& node) {
    const std::size_t dot = last_dot(end);
    if (dot == end.npos || end.substr(0, dot) != instance_.name()) return end;
    const auto target = instance_.shown.find(end.substr(dot + 1));
    if (target) return *target;
    shop_.refuse(file.place_of(node),
                 "'" + end + "' is nothing that the definition shows as written");
    return end;
  }

  void write_connection(const ConnectionEntry& one) {
    const WrittenEnds ends = ends_of(*one.item);
    if (!one.composite.empty()) return;
    const std::string from = inside(ends.from, *one.file, *one.item);
    const std::string to = inside(ends.to, *one.file, *one.item);
    if ((from != ends.from || to != ends.to) && may_write(*one.file, *one.item)) {
      write_ends(one, from, to, shop_);
    }
    for (const Node* port : items_of(find_value(one.item, "ports"))) write_end(*one.file, *port);
    const Node* with = find_value(one.item, "with");
    for (std::size_t i = 1; with != nullptr && i < with->children.size(); i += 2) {
      if (with->children[i]->kind == Node::Kind::kScalar) write_end(*one.file, *with->children[i]);
    }
  }

  void write_end(const SourceText& file, const Node& node) {
    const std::string text = inside(node.text, file, node);
    if (text != node.text && may_write(file, node)) {
      shop_.layout(file).replace(node, make_text(text));
    }
  }

  bool may_write(const SourceText& file, const Node& node) {
    return shop_.require(file, node, "'" + instance_.name() + "'");
  }

  /// Other places that name the instance, or one of its parts.
  void write(const Mention& mention) {
    const std::string before = instance_.name() + ".";
    for (const std::string& name : mention.names()) {
      if (name != instance_.name() && !name.starts_with(before)) continue;
      if (mention.composite == instance_.model()) continue;
      if (!mention.composite.empty()) return refuse(mention, "a composite uses it");
      if (!may_write(*mention.file, *mention.node)) return;
      if (key_around(*mention.node) == "bind") return write_end(*mention.file, *mention.node);
      if (name == instance_.name()) return write_parts_for(mention);
      const std::string text = mention.replaced_names([&](const std::string& one) {
        return one.starts_with(before) ? one.substr(before.size()) : one;
      });
      shop_.layout(*mention.file).replace(*mention.node, make_text(text));
    }
  }

  /// In a list the parts stand for the instance: in `peers` those that serve something.
  void write_parts_for(const Mention& mention) {
    const bool peers = key_around(*mention.node) == "peers";
    const std::vector<std::string> names =
        peers ? instance_.serving_parts() : instance_.part_names();
    const Node& list = *mention.node->parent;
    std::vector<std::string> texts;
    document::Value all = document::make_list();
    for (const std::string& name : names) {
      all.items.push_back(make_text(name));
      texts.push_back(list.flow ? written_in_flow(all.items.back())
                                : written_in_block(all.items.back()));
      if (peers && name.find('.') != name.npos)
        return refuse(mention, "a part inside a part serves it");
    }
    const bool hidden = mention.form != Mention::Form::kName || names.empty();
    if (hidden) return refuse(mention, "it stands for no part here");
    Layout& layout = shop_.layout(*mention.file);
    if (list.kind != Node::Kind::kList) return layout.replace(*mention.node, all);
    if (!list.flow) {
      for (std::size_t i = 1; i < texts.size(); ++i) texts[i].insert(0, "- ");
    }
    layout.replace_element(*mention.node, texts);
  }

  void refuse(const Mention& mention, const std::string& reason) {
    shop_.refuse(mention.file->place_of(*mention.node),
                 "'" + mention.node->text + "' names it here, and " + reason,
                 "take that out first");
  }

  /// It goes with its last instance, if its file may change.
  void remove_definition() {
    const SourceText& file = *instance_.definition_file;
    if (!instance_.is_last || !shop_.may_change(file)) return;
    const bool only = instance_.definition->parent->children.size() == 2;
    if (only) return shop_.layout(file).remove_section(*find_key(file.root(), "composites"));
    shop_.layout(file).remove_with_comments(*instance_.definition);
  }

  const Instance& instance_;
  const SourceText& file_;
  Workshop& shop_;
};

/// How many connections come before those that the file's list gets at its end.
std::ptrdiff_t place_behind(const SourceText& file, const State& before,
                            const std::vector<document::Connection>& connections) {
  const auto& files = before.map->files();
  const auto rank = [&](const SourceText* one) {
    return std::find_if(files.begin(), files.end(),
                        [&](const auto& it) { return it.get() == one; });
  };
  std::ptrdiff_t place = 0;
  for (std::size_t i = 0; i < connections.size(); ++i) {
    const ConnectionEntry* entry = before.map->entry_of(connections[i]);
    const bool earlier =
        entry == nullptr || !entry->composite.empty() || rank(entry->file) <= rank(&file);
    if (earlier) place = static_cast<std::ptrdiff_t>(i) + 1;
  }
  return place;
}

/// The same components in their order; the inner connections stand at the end of the file's list.
Expectation expect_dissolved(const State& before, const Instance& instance) {
  return [&before, instance](const State& after, base::Diagnostics&) {
    const std::string prefix = instance.name() + ".";
    const auto is_inside = [&](const document::Connection& one) {
      const ConnectionEntry* entry = before.map->entry_of(one);
      const auto& inside = instance.connections;
      const bool its = std::find(inside.begin(), inside.end(), entry) != inside.end();
      return its && instance.makes(one);
    };
    Document expected = before.document;
    std::vector<document::Connection> moved;
    std::copy_if(expected.connections.begin(), expected.connections.end(),
                 std::back_inserter(moved), is_inside);
    std::erase_if(expected.connections, is_inside);
    const auto at = place_behind(*instance.entry->file, before, expected.connections);
    expected.connections.insert(expected.connections.begin() + at, moved.begin(), moved.end());
    std::erase_if(expected.composites,
                  [&](const auto& one) { return one.name == instance.name(); });
    expected = renamed(expected, [&](const std::string& full) {
      return full.starts_with(prefix) ? full.substr(prefix.size()) : full;
    });
    take_order_of_modes(after.document, expected);
    return expected;
  };
}

}  // namespace

void draft(const Dissolve& dissolve, Workshop& shop) {
  const std::optional<Instance> instance = Instance::find(dissolve.name, shop);
  if (!instance) return;
  Dissolving(*instance, shop).draft();
  shop.expect(expect_dissolved(shop.before(), *instance));
}

}  // namespace armature::edit::internal
