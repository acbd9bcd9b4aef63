// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/references.hpp"
#include "armature/edit/internal/rewrite.hpp"
#include "armature/edit/internal/targets.hpp"
#include "armature/edit/internal/written_name.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_map;
using document::make_text;
using document::Value;

/// How the last component of a file is written: in block style, or on a line.
int levels_of_neighbours(const SourceText& file) {
  const Node* components = find_value(file.root(), "components");
  if (components == nullptr || components->children.empty()) return 0;
  const Node& last = *components->children.back();
  return last.kind == Node::Kind::kMap && !last.flow ? 1 : 0;
}

/// Whether the component is of the model, and nothing is said of it.
bool is_plain(const document::Component& component, const AddComponent& add) {
  return component.model == add.model && component.properties.empty() && component.peers.empty();
}

void check_plain(const State& before, const Document& document, const Entry& entry,
                 const AddComponent& add, base::Diagnostics& diagnostics) {
  for (const auto& component : document.components) {
    const bool added =
        std::find(entry.names.begin(), entry.names.end(), component.name) != entry.names.end();
    if (!added || is_plain(component, add)) continue;
    diagnostics.error({before.file, 0, 0},
                      refusal_of(add, "'" + component.name + "' would have more than its model"));
  }
}

/// What the document has more then: components of that entry, and nothing else.
Expectation expect_added(const State& before, const AddComponent& add) {
  return [&before, add](const State& after, base::Diagnostics& diagnostics) {
    Document expected = before.document;
    for (const Entry& entry : after.map->entries()) {
      if (entry.changes || !entry.composite.empty() || entry.key->text != add.name) continue;
      const auto is_its = [&](const std::string& name) {
        return std::any_of(entry.names.begin(), entry.names.end(), [&](const std::string& own) {
          return name == own || name.starts_with(own + ".");
        });
      };
      check_plain(before, after.document, entry, add, diagnostics);
      const Document others = without(after.document, is_its);
      for (const std::string& other : differences(before.document, others)) {
        diagnostics.error({before.file, 0, 0}, refusal_of(add, other + " would change"));
      }
      return after.document;
    }
    return expected;
  };
}

/// Adding a component takes nothing from those that are there.
bool is_free(const AddComponent& add, Workshop& shop) {
  for (const Entry& entry : shop.map().entries()) {
    if (!entry.composite.empty() || entry.key->text != add.name) continue;
    shop.refuse(entry.file->place_of(*entry.key), "'" + add.name + "' is there already",
                "choose another name");
    return false;
  }
  if (!document::is_dotted_name(add.model)) {
    shop.refuse("model '" + add.model + "' is not a valid name");
    return false;
  }
  return true;
}

/// The entries of the components that go, and whether the files with them may change.
struct Removal {
  std::vector<const Entry*> entries;
  bool open = true;
};

Removal entries_that_go(const Targets& targets, const Workshop& shop) {
  Removal removal;
  for (const Entry& entry : shop.map().entries()) {
    const bool concerned = std::any_of(entry.names.begin(), entry.names.end(),
                                       [&](const std::string& name) { return targets.has(name); });
    if (!concerned) continue;
    removal.entries.push_back(&entry);
    removal.open = removal.open && is_open({&entry, nullptr}, targets, shop);
  }
  return removal;
}

/// `Log: {remove: true}`, in place of what the deployment's own file changes there.
void override_by_removal(const Targets& targets, Workshop& shop) {
  Value removal = make_map();
  removal.entries.push_back({"remove", make_text("true"), {}, {}});
  for (const std::string& name : targets.names) {
    const auto entries = shop.map().entries_of(name);
    if (entries.empty() || entries.front()->composite.empty()) continue;
    return refuse_site({entries.front(), nullptr}, targets, shop);
  }
  if (const Entry* entry = find_override(targets, shop)) {
    shop.layout(*entry->file).replace(*entry->value, removal);
  } else {
    shop.add_to_section(shop.map().main(), "components", targets.written, removal, 0);
  }
}

void remove_entries(const Targets& targets, Workshop& shop) {
  const Removal removal = entries_that_go(targets, shop);
  if (removal.entries.empty()) {
    return shop.refuse("'" + targets.written + "' is in an OROCOS file, which is not edited",
                       "leave it out here with --override");
  }
  if (shop.overrides() && !removal.open) return override_by_removal(targets, shop);
  for (const Entry* entry : removal.entries) {
    if (!is_open({entry, nullptr}, targets, shop)) {
      return refuse_site({entry, nullptr}, targets, shop);
    }
    shop.layout(*entry->file).remove(*entry->key);
  }
}

bool means_one_of(const Mention& mention, const std::vector<EntryNames>& gone,
                  const Workshop& shop) {
  const std::vector<std::string> names = mention.names();
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::any_of(gone.begin(), gone.end(), [&](const EntryNames& entry) {
      return entry.find(name, mention.composite, shop.map(), shop.document()).has_value();
    });
  });
}

/// True if it goes with one of the entries.
bool is_inside(const Node& node, const std::vector<const Entry*>& entries) {
  for (const Node* around = node.parent; around != nullptr; around = around->parent) {
    const auto is_it = [&](const Entry* entry) { return entry->value == around; };
    if (std::any_of(entries.begin(), entries.end(), is_it)) return true;
  }
  return false;
}

/// Connections of what an override removes go by themselves.
void remove_mentions(const Targets& targets, Workshop& shop) {
  const std::vector<const Entry*> entries = entries_that_go(targets, shop).entries;
  std::vector<EntryNames> gone;
  for (const Entry* entry : entries) {
    if (!entry->changes) gone.emplace_back(*entry);
  }
  for (const Mention& mention : mentions_in(shop.map())) {
    if (is_inside(*mention.node, entries) || !means_one_of(mention, gone, shop)) continue;
    if (mention.in_connection && shop.overrides() && !shop.may_change(*mention.file)) continue;
    if (!shop.require(*mention.file, *mention.node, "'" + mention.node->text + "'")) return;
    shop.layout(*mention.file).remove(*mention.whole);
    if (mention.in_connection) continue;  // nobody expects these to stay
    shop.diagnostics().note(mention.file->place_of(*mention.node),
                            "'" + mention.node->text + "' goes with '" + targets.written + "'");
  }
}

}  // namespace

void draft(const AddComponent& add, Workshop& shop) {
  if (!is_free(add, shop)) return;
  const SourceText& file = shop.file_for_new();
  Value body = make_map();
  body.entries.push_back({"model", make_text(add.model), {}, {}});
  shop.add_to_section(file, "components", add.name, body, levels_of_neighbours(file));
  shop.expect(expect_added(shop.before(), add));
}

void draft(const RemoveComponent& remove, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(remove.name, shop);
  if (!targets) return;
  remove_entries(*targets, shop);
  if (shop.ok()) remove_mentions(*targets, shop);
  const IsGone is_gone = [names = targets->names](const std::string& name) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& own) {
      return name == own || name.starts_with(own + ".");
    });
  };
  shop.expect([&before = shop.before(), is_gone](const State&, base::Diagnostics&) {
    return without(before.document, is_gone);
  });
}

}  // namespace armature::edit::internal
