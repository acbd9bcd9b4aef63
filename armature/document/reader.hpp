// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/fields.hpp"

/// From the tree of a file to the structs of a Document, once ranges and parameters are expanded.
/// Everything that could be read is returned; names of other components are taken as written.
namespace armature::document {

/// A component from what follows its name.
Component read_component(const std::string& name, const base::Location& where, const Value& body,
                         Priorities priorities, base::Diagnostics& diagnostics);

/// Changes `activity` by the keys that `value` has, then checks the whole.
void read_activity(const Value& value, const ValueReader& reader, Priorities priorities,
                   Activity& activity);

/// A connection's map; of `A.Out -> B.In` a map with `from` and `to`.
std::optional<Value> connection_map(const Value& value, base::Diagnostics& diagnostics);

/// A map with `from` and `to`, or one with `name` and `ports`.
std::optional<std::variant<Connection, NamedConnection>> read_connection(
    const Value& map, base::Diagnostics& diagnostics);

/// An input that other processes may write: its name, or a map with `to`; a connection from
/// `kNetworkName`, of a port that is called as the input with its component.
std::optional<Connection> read_input(const Value& value, const ValueReader& reader);

/// Refuses connections that are there twice, leaving one, and names with less than two ports; puts
/// the ports of a name into the order of their components.
void check_connections(Document& document, base::Diagnostics& diagnostics);

std::vector<Export> read_exports(const Value& value, const ValueReader& reader);

/// Refuses missing values in a property and texts that are not of the OROCOS type they name.
void check_values(const std::string& name, const Value& value, const ValueReader& reader);

}  // namespace armature::document
