// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/edit/internal/workshop.hpp"

/// Connections as files and as edits have them.
namespace armature::edit::internal {

/// A connection as an edit names it: its ends, or its name alone.
struct WantedConnection {
  std::string from;
  std::string to;  ///< empty: `from` is its name

  std::string text() const { return from + (to.empty() ? "" : " -> " + to); }
};

/// The ends of an item as written, or its name; empty if it has none.
struct WrittenEnds {
  std::string from;
  std::string to;
  std::string name;
};

WrittenEnds ends_of(const Node& item);

/// Other ends in place of those of the item.
void write_ends(const ConnectionEntry& entry, const std::string& from, const std::string& to,
                Workshop& shop);

/// The items of the files that have it as it is named, or make it; each once.
std::vector<const ConnectionEntry*> find_items(const WantedConnection& wanted,
                                               const Workshop& shop);

void refuse_unknown(const WantedConnection& wanted, Workshop& shop);

/// True if a connection that `entry` makes is meant.
bool is_wanted(const WantedConnection& wanted, const ConnectionEntry& entry,
               const document::Connection& one);

/// Whether all that the item makes is meant.
bool is_all_wanted(const WantedConnection& wanted, const ConnectionEntry& entry,
                   const Workshop& shop);

/// `A.x -> B.y`, or a map if there is more to say.
document::Value connection_item(const std::string& from, const std::string& to,
                                const document::Value& settings);

/// `policy: {fifo: 8}, max_age: 30 ms` as a map; an error and nothing if it is none.
std::optional<document::Value> connection_settings(const std::string& text, Workshop& shop);

/// What a document has of an item with these settings but for its ends and `with`; nothing if
/// braces in it stand for something.
std::optional<document::Connection> plain_settings(const document::Value& settings);

/// True if the connection has the settings; nothing is true of all.
bool has_settings(const document::Connection& connection,
                  const std::optional<document::Connection>& settings);

}  // namespace armature::edit::internal
