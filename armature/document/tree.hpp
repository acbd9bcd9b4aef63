// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/document/document.hpp"

namespace armature::document {

/// The document as the tree that a YAML file of it has; what has its default is left out.
Value to_tree(const Document& document);

/// The policy's keys as entries of a connection's map.
void add_policy(const ConnectionPolicy& policy, Value& map);

Value to_tree(const Connection& connection);

}  // namespace armature::document
