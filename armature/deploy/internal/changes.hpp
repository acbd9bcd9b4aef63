// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/internal/expand_names.hpp"
#include "armature/document/document.hpp"

/// What a file says of entries that a file has which it includes: `override: true`, `remove: true`.
namespace armature::deploy::internal {

/// A component's entry that changes one written elsewhere.
bool is_change(const document::Value& body);

/// `{remove: true}`.
bool is_removal(const document::Value& value);

/// What changes a component that is written elsewhere.
struct Change {
  document::Value body;
  base::Location where;
  bool exported;  ///< by a value for a property that a composite exports
};
using ChangesByName = std::map<std::string, std::vector<Change>>;

/// Refuses a removal that says something else, too.
void check_change(const std::string& name, const document::Value& body,
                  base::Diagnostics& diagnostics);

/// Whether a change takes the component out; no change of it is left then.
bool take_removal(ChangesByName& changes, const std::string& name);

/// `change` over `base`: properties and bindings one by one, all other keys as a whole.
void apply_change(document::Value& base, const document::Value& change,
                  base::Diagnostics& diagnostics);

/// What is removed while a document is built, which takes it out at the end.
class Removals {
 public:
  /// `name` in the composite `instance`; of the application if that is empty. Its connections go
  /// with it.
  void add_component(const std::string& instance, const std::string& name);
  void add_connection(const std::string& instance, document::Connection connection);
  void add_named(const std::string& instance, document::Reference name);

  /// Names in the document are as written; an error for what is not there to be removed.
  void apply(document::Document& document, Scopes& scopes, base::Diagnostics& diagnostics) const;

 private:
  template <typename Text>
  struct In {
    std::string instance;
    Text what;
  };
  std::set<std::string> components_;  ///< full names
  std::vector<In<document::Connection>> connections_;
  std::vector<In<document::Reference>> named_;
};

}  // namespace armature::deploy::internal
