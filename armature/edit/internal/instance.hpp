// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "armature/edit/internal/shown_members.hpp"
#include "armature/edit/internal/workshop.hpp"

namespace armature::edit::internal {

/// An instance of a composite, and its definition in the files.
struct Instance {
  const Entry* entry = nullptr;
  const document::Composite* composite = nullptr;
  const SourceText* definition_file = nullptr;
  const Node* definition = nullptr;  ///< its key
  std::vector<const Entry*> parts;
  std::vector<const ConnectionEntry*> connections;
  ShownMembers shown{nullptr};
  bool is_last = false;  ///< nothing else is made of the definition
  std::vector<std::pair<std::string, document::Value>> parameters;  ///< and what they are here

  /// The only one of its entry; errors and nothing if it cannot be dissolved.
  static std::optional<Instance> find(const std::string& name, Workshop& shop);

  const std::string& name() const { return composite->name; }
  const std::string& model() const { return composite->model; }

  /// The text without `${name}` of the composite, or the list or map that one stands for; nothing
  /// if it has none.
  std::optional<document::Value> without_parameters(const std::string& text) const;

  /// Its parts as their entries make them.
  std::vector<std::string> part_names() const;
  /// Those that peers of the instance use.
  std::vector<std::string> serving_parts() const;
  /// True if the connection is of this instance.
  bool makes(const document::Connection& one) const;

 private:
  bool find_definition(Workshop& shop);
  bool find_parameters(Workshop& shop);
  bool is_free(Workshop& shop) const;
};

}  // namespace armature::edit::internal
