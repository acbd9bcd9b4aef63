// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/edit/internal/group_members.hpp"

namespace armature::edit::internal {

/// The definition of a composite with entries and connections as they are, and an instance in their
/// place. Parameters that they use become those of the composite.
void write_definition(const std::string& name, const GroupMembers& members,
                      const std::vector<const ConnectionEntry*>& connections,
                      const document::Value& exports, Workshop& shop);

/// The key of a file's own map in which a node stands: `modes`.
std::string section_of(const Node& node);

/// Of the entry's map in which a node stands: `peers`.
std::string key_around(const Node& node);

/// The composite of that name as `found` has it, in its place among the others.
void add_composite(const document::Document& found, const std::string& name,
                   document::Document& expected);

/// Modes are sets: the order in which they name the same components does not count.
void take_order_of_modes(const document::Document& found, document::Document& expected);

/// Tells of texts in properties that may mean one of the components, which nobody but their
/// component knows.
void warn_of_properties(const std::vector<std::string>& names, Workshop& shop);

}  // namespace armature::edit::internal
