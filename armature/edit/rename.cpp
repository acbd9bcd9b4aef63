// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/definition_text.hpp"
#include "armature/edit/internal/references.hpp"
#include "armature/edit/internal/rewrite.hpp"
#include "armature/edit/internal/targets.hpp"
#include "armature/edit/internal/written_name.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_text;

/// What has the name that is to change.
struct Named {
  EntryNames names;
  std::vector<Site> sites;  ///< where it is declared; without entry for a connection's name
  std::vector<std::string> full_names;
  const SourceText* file = nullptr;  ///< of a connection
};

bool same_names(const Targets& targets, const Entry& entry) {
  return targets.has_all_of(entry) && entry.names.size() == targets.names.size();
}

std::optional<Named> find_component(const Rename& rename, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(rename.from, shop);
  if (!targets) return std::nullopt;
  const std::vector<const Entry*> entries = shop.map().entries_of(targets->names.front());
  if (entries.empty() || entries.front()->changes) {
    shop.refuse("'" + rename.from + "' is in an OROCOS file, which is not edited");
    return std::nullopt;
  }
  if (!same_names(*targets, *entries.front())) {
    refuse_site({entries.front(), nullptr}, *targets, shop);
    if (shop.ok()) shop.refuse("'" + rename.from + "' is not all of an entry");
    return std::nullopt;
  }
  Named named{EntryNames(*entries.front()), {}, targets->names, nullptr};
  for (const Entry& entry : shop.map().entries()) {
    if (entry.composite != entries.front()->composite) continue;
    if (named.names.find_key(entry.key->text)) named.sites.push_back({&entry, entry.key});
  }
  return named;
}

/// What gives a command is known by the name of its connection.
std::optional<Named> find_connection(const Rename& rename, const Workshop& shop) {
  for (const auto& connection : shop.document().connections) {
    if (connection.name.empty() || connection.name != rename.from) continue;
    const ConnectionEntry* entry = shop.map().entry_of(connection);
    if (entry == nullptr || !entry->composite.empty()) continue;
    const Node* name = find_value(entry->item, "name");
    if (name == nullptr || name->text != rename.from) continue;
    return Named{EntryNames(rename.from), {{nullptr, name}}, {rename.from}, entry->file};
  }
  return std::nullopt;
}

/// `to` as the key of an entry: with the range that it has, without the composite before a part.
std::optional<WrittenName> new_key(const Rename& rename, const Named& named, Workshop& shop) {
  const WrittenName& old = named.names.written();
  const std::string beside =
      rename.from.substr(0, std::max(rename.from.size(), old.text().size()) - old.text().size());
  const bool whole = !beside.empty() && rename.to.starts_with(beside);
  WrittenName key = WrittenName::of(whole ? rename.to.substr(beside.size()) : rename.to);
  const bool of_component = named.file == nullptr;
  if (of_component && (key.begin + key.end).find('.') != std::string::npos) {
    shop.refuse("'" + rename.to + "' has a dot, which stands between a composite and its part",
                "a component stays in its composite; give it a name without one");
    return std::nullopt;
  }
  const bool same = key.braces == WrittenName::of(rename.from).braces;
  if (!same) {
    shop.refuse(
        "a range keeps its numbers: '" + rename.from + "' cannot become '" + rename.to + "'",
        "write the braces as they are");
    return std::nullopt;
  }
  key.braces = old.braces;
  return key;
}

std::string named_anew(const EntryNames::Meant& meant, const WrittenName& key) {
  return meant.before + key.begin + meant.number + key.end + meant.behind;
}

void rename_mentions(const Named& named, const WrittenName& key, Workshop& shop) {
  for (const Mention& mention : mentions_in(shop.map())) {
    const std::string text = mention.replaced_names([&](const std::string& name) {
      const auto meant = named.names.find(name, mention.composite, shop.map(), shop.document());
      return meant ? named_anew(*meant, key) : name;
    });
    if (text == mention.node->text) continue;
    if (!shop.require(*mention.file, *mention.node, "'" + mention.node->text + "'")) return;
    shop.layout(*mention.file).replace(*mention.node, make_text(text));
  }
}

/// Full names before and after; parts of a composite go with it.
NewName new_names(const Named& named, const WrittenName& key) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& full : named.full_names) {
    const WrittenName& old = named.names.written();
    const std::size_t level = named.names.composite().empty() ? 0 : full.rfind('.') + 1;
    const std::size_t size = full.size() - level - old.begin.size() - old.end.size();
    const std::string number = full.substr(level + old.begin.size(), size);
    pairs.emplace_back(full, full.substr(0, level) + key.begin + number + key.end);
  }
  return [pairs](const std::string& name) {
    for (const auto& [old, renamed] : pairs) {
      if (name == old) return renamed;
      if (name.starts_with(old) && name[old.size()] == '.')
        return renamed + name.substr(old.size());
    }
    return name;
  };
}

}  // namespace

void draft(const Rename& rename, Workshop& shop) {
  std::optional<Named> named = find_connection(rename, shop);
  if (!named) named = find_component(rename, shop);
  if (!named) return;
  const std::optional<WrittenName> key = new_key(rename, *named, shop);
  if (!key) return;
  if (key->text() == named->names.written().text()) return shop.refuse("it has that name already");
  for (const Site& site : named->sites) {
    const SourceText& file = site.entry == nullptr ? *named->file : *site.entry->file;
    if (!shop.require(file, *site.node, "'" + site.node->text + "'")) return;
    const auto meant = named->names.find_key(site.node->text);
    shop.layout(file).replace(*site.node, make_text(named_anew(*meant, *key)));
  }
  rename_mentions(*named, *key, shop);
  warn_of_properties(named->full_names, shop);
  const NewName new_name = new_names(*named, *key);
  shop.expect([&before = shop.before(), new_name](const State&, base::Diagnostics&) {
    return renamed(before.document, new_name);
  });
}

}  // namespace armature::edit::internal
