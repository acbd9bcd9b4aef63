// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/fields.hpp"

namespace armature::document {

/// Says so if `value` is there and is not of that kind.
bool require_kind(const Value* value, Value::Kind kind, std::string_view key,
                  const ValueReader& reader);

/// The sections that a document may have, each with the right kind of value; errors for all else.
std::vector<Property> sections_of(Value tree, base::Diagnostics& diagnostics);

/// The part of the tree that concerns the application as a whole.
Value head_of(const Value& tree);

/// Name, fault policy, libraries, grants and the record of composites.
void read_head(const Value& head, Document& document, base::Diagnostics& diagnostics);

/// Paths as seen from the document's folder, whichever file they were written in.
void rebase_paths(Document& document);

}  // namespace armature::document
