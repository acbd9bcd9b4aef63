// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/limits.hpp"
#include "armature/document/ranges.hpp"

/// Ranges (document/ranges.hpp) and parameters `${name}` in trees.
namespace armature::deploy::internal {

using namespace document;

std::vector<std::string> names_of(const std::vector<Property>& properties);

/// What names in braces stand for.
struct Scope {
  std::vector<Property> parameters;  ///< their final values
  std::string owner;                 ///< whose parameters: `the document`, `composite 'Chassis'`
  std::optional<int> number;         ///< `{i}`, inside a range
};

/// Makes expanded copies of trees, as many as the limits allow.
class Expander {
 public:
  explicit Expander(const Limits& limits)
      : nodes_left_(limits.expanded_nodes), most_entries_(limits.expanded_entries) {}

  /// A copy of `value`: list items and keys with a range are repeated, all else is replaced.
  Value expand(const Value& value, const Scope& scope, base::Diagnostics& diagnostics);

  std::string expand_text(const Value& text, const Scope& scope, base::Diagnostics& diagnostics);

  /// `${name}` replaced in a text.
  std::string replace_parameters(std::string_view text, const Scope& scope,
                                 const base::Location& where, base::Diagnostics& diagnostics);

  /// Where a text got what may be wrong with it: its first parameter's value, or its own place.
  static base::Location origin_of(std::string_view text, const Scope& scope,
                                  const base::Location& where);

  /// Final values of parameters that may use one another: `declared` with those of `given` instead.
  std::vector<Property> resolve_parameters(const std::vector<Property>& declared,
                                           const std::vector<Property>& given,
                                           const std::string& owner,
                                           base::Diagnostics& diagnostics);

  /// Counts `count` components, composites or connections before they are made; false once there
  /// would be more than the limits allow, which is reported.
  bool spend_entries(std::size_t count, const std::string& what, const base::Location& where,
                     base::Diagnostics& diagnostics);

  /// True once a limit is passed; it has been reported then, and copies are empty.
  bool exhausted() const { return exhausted_; }

 private:
  bool spend(std::size_t nodes, const base::Location& where, base::Diagnostics& diagnostics);
  Value expand_whole_text(const Value& value, const Scope& scope, base::Diagnostics& diagnostics);
  void expand_item(const Value& item, const Scope& scope, Value& list,
                   base::Diagnostics& diagnostics);
  void expand_entry(const Property& entry, const Scope& scope, Value& map,
                    base::Diagnostics& diagnostics);
  static void refuse_twins(const Value& map, base::Diagnostics& diagnostics);

  std::size_t nodes_left_;
  std::size_t most_entries_;
  std::size_t entries_ = 0;
  bool exhausted_ = false;
};

}  // namespace armature::deploy::internal
