// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/group_members.hpp"

#include <algorithm>

#include "armature/document/fields.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

std::string quoted_key(const Entry& entry) { return "'" + entry.key->text + "'"; }

}  // namespace

bool GroupMembers::is_part_of_file(const Group& group, Workshop& shop) const {
  for (const Entry* entry : entries_) {
    if (!entry->composite.empty()) {
      shop.refuse(entry->file->place_of(*entry->key),
                  quoted_key(*entry) + " is a part of composite '" + entry->composite + "'",
                  "group components of the application");
    } else if (entry->file != &file()) {
      shop.refuse(
          entry->file->place_of(*entry->key),
          quoted_key(*entry) + " stands in another file than " + quoted_key(*entries_.front()),
          "group those of one file");
    } else if (shop.require(*entry->file, *entry->key, quoted_key(*entry))) {
      continue;
    }
    return false;
  }
  return !group.parts.empty();
}

/// What overrides a component cannot override a part of a composite.
bool GroupMembers::is_free_of_changes(Workshop& shop) const {
  for (const Entry& other : shop.map().entries()) {
    const bool concerned =
        other.changes && std::any_of(other.names.begin(), other.names.end(),
                                     [&](const std::string& name) { return has(name); });
    if (!concerned) continue;
    shop.refuse(other.file->place_of(*other.key),
                quoted_key(other) + " is overridden here, and parts of composites are not",
                "write it at the component first");
    return false;
  }
  return true;
}

/// What stands between them would run in another order.
bool GroupMembers::stand_together(Workshop& shop) const {
  const auto& all = shop.map().entries();
  const auto index = [&](const Entry* entry) { return entry - all.data(); };
  for (auto i = index(entries_.front()); i < index(entries_.back()); ++i) {
    const Entry& between = all[static_cast<std::size_t>(i)];
    const bool own = std::find(entries_.begin(), entries_.end(), &between) != entries_.end();
    if (own || between.changes || between.names.empty()) continue;
    shop.refuse(between.file->place_of(*between.key),
                quoted_key(between) + " stands between " + quoted_key(*entries_.front()) + " and " +
                    quoted_key(*entries_.back()) +
                    " in the file, and would start and run in another order",
                "group it, too, or move it in the text first");
    return false;
  }
  return true;
}

std::optional<GroupMembers> GroupMembers::find(const Group& group, Workshop& shop) {
  GroupMembers members;
  for (const std::string& part : group.parts) {
    const Entry* entry = find_whole_entry(part, shop);
    if (entry == nullptr) return std::nullopt;
    auto& entries = members.entries_;
    if (std::find(entries.begin(), entries.end(), entry) == entries.end()) entries.push_back(entry);
  }
  if (members.entries_.empty()) {
    shop.refuse("it names no components", "name those that become its parts");
    return std::nullopt;
  }
  std::sort(members.entries_.begin(), members.entries_.end());  // as they stand in the source map
  for (const Entry* entry : members.entries_) members.names_.emplace_back(*entry);
  const bool possible = members.is_part_of_file(group, shop) && members.is_free_of_changes(shop) &&
                        members.stand_together(shop);
  return possible ? std::optional(std::move(members)) : std::nullopt;
}

bool GroupMembers::has(const std::string& written, const std::string& composite,
                       const Workshop& shop) const {
  return std::any_of(names_.begin(), names_.end(), [&](const EntryNames& names) {
    return names.find(written, composite, shop.map(), shop.document()).has_value();
  });
}

bool GroupMembers::has(const std::string& name) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry* entry) {
    return std::any_of(entry->names.begin(), entry->names.end(), [&](const std::string& own) {
      return name == own || name.starts_with(own + ".");
    });
  });
}

bool GroupMembers::contains(const Node& node) const {
  for (const Node* around = &node; around != nullptr; around = around->parent) {
    const auto is_it = [&](const Entry* entry) { return entry->value == around; };
    if (std::any_of(entries_.begin(), entries_.end(), is_it)) return true;
  }
  return false;
}

}  // namespace armature::edit::internal
