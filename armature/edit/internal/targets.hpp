// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "armature/edit/internal/workshop.hpp"

/// Which entries of which files an edit of components is about.
namespace armature::edit::internal {

/// The components and composites that an edit names.
struct Targets {
  std::string written;             ///< as the edit names them: `Joint{1..3}`
  std::vector<std::string> names;  ///< full names; never empty
  std::string rest;                ///< of a path: what follows the dot

  bool has(const std::string& name) const;
  bool has_all_of(const Entry& entry) const;
};

/// Those of `Joint1`, `Joint{1..3}`, a key as the file has it, or a part of a composite's
/// definition, `Chassis.left`. An error and nothing if the deployment has none of them.
std::optional<Targets> find_targets(const std::string& written, Workshop& shop);

/// Of a path `Component.rest`; the component's name is as long as possible.
std::optional<Targets> find_targets_of_path(const std::string& path, Workshop& shop);

/// The entry that makes exactly the components that are named. An error and nullptr if there is
/// none, or not in a file that is edited.
const Entry* find_whole_entry(const std::string& written, Workshop& shop);

/// The first dot that is not in braces.
std::size_t find_dot(const std::string& path);

/// Full names of components, composites and connections with a name.
std::set<std::string> names_in(const document::Document& document);

/// The component's property, the composite's parameter, or what it exports; nullptr if it has no
/// value.
const document::Value* find_property(const document::Document& document, const std::string& name,
                                     const std::string& path);

/// As the command line would set it: `Joint1.Gain=2`.
std::string setting(const std::string& name, const std::string& path, const std::string& value);

/// Where a value stands in an entry, nullptr if it does not.
using FindNode = std::function<const Node*(const Entry& entry)>;

/// A value that the document has from an entry.
struct Site {
  const Entry* entry = nullptr;
  const Node* node = nullptr;
};

/// The entries that have the last word on a value of the targets, each once. `without` gets the
/// names of the targets that have none.
std::vector<Site> sites_in_force(const Targets& targets, const FindNode& find, const Workshop& shop,
                                 std::vector<std::string>& without);

/// True if the edit may change the site's file, and the entry stands for nothing but the targets.
bool is_open(const Site& site, const Targets& targets, const Workshop& shop);

/// Says why it is not.
void refuse_site(const Site& site, const Targets& targets, Workshop& shop);

/// The entry where the edit may write something new of a target, nullptr if it may in none.
const Entry* open_entry(const std::string& name, const Targets& targets, const Workshop& shop);

/// True if the edit may override, and cannot change all of the sites and write all of what is new
/// where it belongs.
bool needs_override(const std::vector<Site>& sites, const std::vector<std::string>& without,
                    const Targets& targets, const Workshop& shop);

/// The entries where the edit may write something new of the targets `without` it, each once; an
/// error and none if it may not for one of them.
std::vector<const Entry*> entries_for_new(const std::vector<std::string>& without,
                                          const Targets& targets, Workshop& shop);

/// The entry of the deployment's own file that overrides the targets and nothing else, nullptr if
/// it has none.
const Entry* find_override(const Targets& targets, const Workshop& shop);

/// Adds `Joint2: {override: true, key: value}` to the deployment's own file.
void add_override(const Targets& targets, const std::string& key, const document::Value& value,
                  Workshop& shop);

/// `properties` of an entry, or another of its maps; nullptr if it has none.
const Node* find_map(const Entry& entry, const std::string& key);

/// Adds `name: value` to a map of the entry, which is made if need be.
void add_to_entry(const Entry& entry, const std::string& map, const std::string& name,
                  const document::Value& value, Workshop& shop);

}  // namespace armature::edit::internal
