// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"

namespace armature::document {

/// `file:line:column`, as far as known.
std::string place_text(const base::Location& where);

/// Levels of the tree; 1 for a text.
std::size_t depth_of(const Value& value);

/// Texts, lists and maps in the tree.
std::size_t count_nodes(const Value& value);

Value make_text(std::string text, base::Location where = {});
Value make_list(base::Location where = {});
Value make_map(base::Location where = {});

/// `text`, a list or a map, for messages: "found a list".
using types::name_of;

std::string_view name_of(Value::Kind kind);

/// Without blanks and line ends around it.
std::string_view trimmed(std::string_view text);

/// `'Joint1'`, or a shortened form of a long text.
std::string in_quotes(std::string_view text);

/// Never shortened: somebody is to find the file.
std::string path_in_quotes(std::string_view path);

}  // namespace armature::document
