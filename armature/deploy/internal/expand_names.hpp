// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"

namespace armature::deploy::internal {

using namespace document;

/// `scope.name`, or the name where the scope is the document.
std::string full_name(std::string_view scope, const std::string& name);

/// The full names of components and composites, and who may use which. A name inside a composite
/// means its part of that name, or else what the name means where the composite is used.
class NameTable {
 public:
  /// False if the name is taken. `parent` is the composite around it, empty for the application.
  bool add(const std::string& name, const std::string& parent, const base::Location& where);
  const base::Location& place_of(const std::string& name) const { return places_.at(name).where; }
  bool contains(const std::string& name) const { return places_.count(name) > 0; }

  /// The full name of what `name` means inside `scope`; `name` itself if it means nothing there.
  std::string resolve(std::string_view scope, const std::string& name) const;

  /// True if `name` is not hidden in a composite that `scope` is outside of.
  bool visible(std::string_view scope, const std::string& name) const;
  const std::string& parent_of(const std::string& name) const { return places_.at(name).parent; }

 private:
  struct Place {
    std::string parent;
    base::Location where;
  };
  std::unordered_map<std::string, Place> places_;
};

/// Which composite's text an entry of a Document comes from, for each entry; empty: the document's.
struct Scopes {
  std::vector<std::string> components;
  std::vector<std::string> connections;
  std::vector<std::string> named_connections;
};

/// Replaces names in peers, bindings, delays, connections and exports by full names of components,
/// exported names by those of the parts.
void resolve_names(Document& document, const Scopes& scopes, const NameTable& names,
                   base::Diagnostics& diagnostics);

}  // namespace armature::deploy::internal
