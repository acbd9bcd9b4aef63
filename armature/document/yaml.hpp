// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/limits.hpp"

namespace armature::document {

/// Begins the tag of a map that is an OROCOS struct: `!orocos:KDL.Frame`.
inline constexpr std::string_view kStructTag = "orocos:";

/// YAML text as a tree with the place of each node; kNone if it is empty or, with errors, not YAML.
/// Aliases are copied and count as often as they are used.
Value parse_yaml(std::string_view text, const std::string& file, const Limits& limits,
                 base::Diagnostics& diagnostics);

/// Likewise for a value given on the command line or in an attribute: every node is at `where`.
Value parse_yaml_value(std::string_view text, const base::Location& where, const Limits& limits,
                       base::Diagnostics& diagnostics);

/// What `{i}` and `${name}` in the texts of a value are: final text, as in a document, or what a
/// file has them for. Those of `!literal` values are text in any case.
enum class InBraces { kText, kMeant };

/// The value as YAML on one line.
std::string flow_text(const Value& value, InBraces in_braces = InBraces::kText);

/// A map as a YAML file.
std::string block_text(const Value& map);

/// The document in YAML, in its short forms; reads back as the same document.
std::string write_yaml(const Document& document);

}  // namespace armature::document
