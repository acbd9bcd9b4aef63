// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/border.hpp"
#include "armature/edit/internal/definition_text.hpp"
#include "armature/edit/internal/group_members.hpp"
#include "armature/edit/internal/repetition.hpp"
#include "armature/edit/internal/rewrite.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::ExportKind;
using document::make_text;
using document::Range;

std::string component_of(const std::string& end) {
  const std::size_t dot = last_dot(end);
  return dot == end.npos ? std::string() : end.substr(0, dot);
}

/// What a connection's item is made of, as far as a group is concerned.
struct Crossing {
  const ConnectionEntry* entry;
  WrittenEnds ends;
  std::optional<Range> range;
  bool commands;  ///< an event gives a command
};

/// Makes the text of one edit.
class Grouping {
 public:
  Grouping(const Group& group, const GroupMembers& members, Workshop& shop)
      : group_(group), members_(members), shop_(shop), border_(group.name) {}

  void draft() {
    for (const ConnectionEntry& entry : shop_.map().connections()) sort(entry);
    for (const Crossing& one : crossings_) each_end(one, Visit::kWant);
    border_.give_names();
    for (const Crossing& one : crossings_) each_end(one, Visit::kWrite);
    for (const Mention& mention : mentions_in(shop_.map())) {
      if (!mention.in_connection && shop_.ok()) write(mention);
    }
    if (shop_.ok()) write_definition(group_.name, members_, inside_, border_.exports(), shop_);
  }

  const std::vector<const ConnectionEntry*>& inside() const { return inside_; }

 private:
  enum class Visit { kWant, kWrite };

  bool has(const std::string& end) const { return members_.has(component_of(end), {}, shop_); }

  /// Connections between parts go inside, but those that others know by their name.
  void sort(const ConnectionEntry& entry) {
    const Node& item = *entry.item;
    const WrittenEnds ends = ends_of(item);
    if (!entry.composite.empty()) return refuse_inside_of_others(entry, ends);
    const bool from = has(ends.from);
    const bool to = has(ends.to);
    if ((from || to) && find_value(&item, "remove") != nullptr) {
      return shop_.refuse(entry.file->place_of(item), "a connection of it is left out here",
                          "remove the connection first");
    }
    const bool named = find_value(&item, "name") != nullptr;
    if (from && to && !named && entry.file == &members_.file()) return inside_.push_back(&entry);
    const bool commands = named || find_value(&item, "on") != nullptr ||
                          find_value(&item, "do") != nullptr ||
                          find_value(&item, "with") != nullptr;
    crossings_.push_back({&entry, ends, repetition_of(entry, ends, shop_), commands});
  }

  void refuse_inside_of_others(const ConnectionEntry& entry, const WrittenEnds& ends) {
    for (const std::string& end : {ends.from, ends.to}) {
      if (!members_.has(component_of(end), entry.composite, shop_)) continue;
      shop_.refuse(entry.file->place_of(*entry.item),
                   "composite '" + entry.composite + "' connects '" + end + "', which would hide");
    }
  }

  void each_end(const Crossing& one, Visit visit) {
    const auto used = [&](ExportKind kind, const std::string& end, const auto& range) {
      return use(one, kind, end, range, range, visit);
    };
    const Node& item = *one.entry->item;
    const std::string from =
        used(one.commands ? ExportKind::kEvent : ExportKind::kPort, one.ends.from, one.range);
    const std::string to =
        used(one.commands ? ExportKind::kOperation : ExportKind::kPort, one.ends.to, one.range);
    const bool changed = from != one.ends.from || to != one.ends.to;
    if (visit == Visit::kWrite && changed && may_write(*one.entry)) {
      write_ends(*one.entry, from, to, shop_);
    }
    for (const Node* port : items_of(find_value(&item, "ports"))) {
      base::Diagnostics ignored;
      const auto found = document::find_range(port->text, {}, ignored);
      const auto range = found ? std::optional(found->range) : std::nullopt;
      replace(one, *port, use(one, ExportKind::kPort, port->text, range, range, visit), visit);
    }
    const Node* with = find_value(&item, "with");
    for (std::size_t i = 1; with != nullptr && i < with->children.size(); i += 2) {
      const Node& value = *with->children[i];
      if (value.kind != Node::Kind::kScalar) continue;
      replace(one, value, use(one, ExportKind::kPort, value.text, one.range, {}, visit), visit);
    }
  }

  /// @return how the end is written outside; as it is if it is no part's
  std::string use(const Crossing& one, ExportKind kind, const std::string& end,
                  const std::optional<Range>& range, const std::optional<Range>& written,
                  Visit visit) {
    if (!has(end)) return end;
    const EndText text = EndText::of(end);
    if (text.shifted || (text.repeats() && !range)) {
      shop_.refuse(one.entry->file->place_of(*one.entry->item),
                   "'" + end + "' crosses the composite's border, which shows no shifted range",
                   "group both ends, or write the range out first");
    }
    if (visit == Visit::kWant) border_.want(kind, end, range);
    return visit == Visit::kWant || !shop_.ok() ? end : border_.outside(kind, end, written);
  }

  void replace(const Crossing& one, const Node& node, const std::string& text, Visit visit) {
    if (visit == Visit::kWant || text == node.text || !may_write(*one.entry)) return;
    shop_.layout(*one.entry->file).replace(node, make_text(text));
  }

  bool may_write(const ConnectionEntry& entry) {
    return shop_.require(*entry.file, *entry.item, "the connection");
  }

  /// What else names a part from outside.
  void write(const Mention& mention) {
    const auto names = mention.names();
    const bool concerned = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return members_.has(name, mention.composite, shop_);
    });
    if (!concerned || members_.contains(*mention.node)) return;
    const std::string section = section_of(*mention.node);
    const std::string key = key_around(*mention.node);
    const bool hidden = !mention.composite.empty() || key == "peers" || key == "bind";
    if (hidden) return refuse_hidden(mention, key);
    if (section == "modes") return;  // all of a mode's at once
    if (!shop_.require(*mention.file, *mention.node, "'" + mention.node->text + "'")) return;
    const std::string text =
        mention.replaced_names([&](const std::string& name) { return group_.name + "." + name; });
    shop_.layout(*mention.file).replace(*mention.node, make_text(text));
  }

  void refuse_hidden(const Mention& mention, const std::string& key) {
    shop_.refuse(mention.file->place_of(*mention.node),
                 "'" + mention.node->text + "' stands in '" + key +
                     "' of a component outside, and a composite hides its parts",
                 "group that component, too");
  }

  const Group& group_;
  const GroupMembers& members_;
  Workshop& shop_;
  Border border_;
  std::vector<Crossing> crossings_;
  std::vector<const ConnectionEntry*> inside_;
};

/// A mode has all of the parts, or none.
void write_modes(const Group& group, const GroupMembers& members, Workshop& shop) {
  for (const Mention& mention : mentions_in(shop.map())) {
    if (section_of(*mention.node) != "modes" || !members.has(mention.node->text, {}, shop))
      continue;
    if (!shop.require(*mention.file, *mention.node, "the mode")) return;
    const Node& list = *mention.node->parent;
    const auto first =
        std::find_if(list.children.begin(), list.children.end(),
                     [&](const Node* one) { return members.has(one->text, {}, shop); });
    const bool alone = list.kind == Node::Kind::kMap;  // the value is no list
    if (alone || *first == mention.node) {
      shop.layout(*mention.file).replace(*mention.node, make_text(group.name));
    } else {
      shop.layout(*mention.file).remove(*mention.node);
    }
  }
}

bool modes_have_all_or_none(const GroupMembers& members, Workshop& shop) {
  for (const auto& mode : shop.document().modes) {
    for (const auto& component : shop.document().components) {
      const auto is_it = [&](const auto& one) { return one.name == component.name; };
      const bool in = std::any_of(mode.components.begin(), mode.components.end(), is_it);
      const bool any = std::any_of(mode.components.begin(), mode.components.end(),
                                   [&](const auto& one) { return members.has(one.name); });
      if (!members.has(component.name) || in || !any) continue;
      shop.refuse(mode.where,
                  "mode '" + mode.name + "' has others of its parts, but not '" + component.name +
                      "', and a composite in a mode has all its parts",
                  "group those of one mode");
      return false;
    }
  }
  return true;
}

bool is_free(const std::string& name, Workshop& shop) {
  const Document& document = shop.document();
  const auto has_model = [&](const auto& one) { return one.model == name; };
  const bool defined =
      std::any_of(shop.map().files().begin(), shop.map().files().end(), [&](const auto& file) {
        return find_key(find_value(file->root(), "composites"), name) != nullptr;
      });
  const bool taken = defined || names_in(document).contains(name) ||
                     std::ranges::any_of(document.components, has_model) ||
                     std::ranges::any_of(document.composites, has_model);
  if (!document::is_name(name)) {
    shop.refuse("'" + name + "' is not a valid name", "letters, digits, '_' and '-'");
  } else if (taken) {
    shop.refuse("'" + name + "' is the name of a component, composite or model already",
                "choose another name");
  }
  return shop.ok();
}

/// The same components and connections in their order, but that inner connections come first.
Expectation expect_grouped(const State& before, const std::string& name,
                           const std::vector<std::string>& parts,
                           const std::vector<const ConnectionEntry*>& inside) {
  return [&before, name, parts, inside](const State& after, base::Diagnostics&) {
    const auto is_inside = [&](const document::Connection& one) {
      return std::find(inside.begin(), inside.end(), before.map->entry_of(one)) != inside.end();
    };
    Document expected = before.document;
    std::vector<document::Connection> moved;
    std::copy_if(expected.connections.begin(), expected.connections.end(),
                 std::back_inserter(moved), is_inside);
    std::erase_if(expected.connections, is_inside);
    const auto& found = after.document.connections;
    const auto first = std::find_if(found.begin(), found.end(), [&](const auto& one) {
      const ConnectionEntry* entry = after.map->entry_of(one);
      return entry != nullptr && entry->composite == name;
    });
    const auto at =
        std::min<std::ptrdiff_t>(first - found.begin(), std::ssize(expected.connections));
    expected.connections.insert(expected.connections.begin() + at, moved.begin(), moved.end());
    expected = renamed(expected, [&](const std::string& full) {
      const auto is_part = [&](const std::string& part) {
        return full == part || full.starts_with(part + ".");
      };
      return std::ranges::any_of(parts, is_part) ? name + "." + full : full;
    });
    add_composite(after.document, name, expected);
    take_order_of_modes(after.document, expected);
    return expected;
  };
}

}  // namespace

void draft(const Group& group, Workshop& shop) {
  if (!is_free(group.name, shop)) return;
  const std::optional<GroupMembers> members = GroupMembers::find(group, shop);
  if (!members || !modes_have_all_or_none(*members, shop)) return;
  Grouping grouping(group, *members, shop);
  grouping.draft();
  write_modes(group, *members, shop);
  std::vector<std::string> parts;
  for (const Entry* entry : members->entries()) {
    parts.insert(parts.end(), entry->names.begin(), entry->names.end());
  }
  warn_of_properties(parts, shop);
  shop.expect(expect_grouped(shop.before(), group.name, parts, grouping.inside()));
}

}  // namespace armature::edit::internal
