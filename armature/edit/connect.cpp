// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "armature/base/near_name.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/connection_items.hpp"
#include "armature/edit/internal/set_value.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Connection;
using document::Document;
using document::make_text;
using document::Value;

/// The item that the edit has added: the last one of the list.
const Node* added_item(const SourceMap& map, const std::string& path) {
  const SourceText* file = map.file(path);
  const auto items = items_of(find_value(file == nullptr ? nullptr : file->root(), "connections"));
  return items.empty() ? nullptr : items.back();
}

void check_end(const State& before, const document::Endpoint& end,
               const std::set<std::string>& known, const Connect& connect,
               base::Diagnostics& diagnostics) {
  if (known.contains(end.component)) return;
  diagnostics.error({before.file, 0, 0},
                    refusal_of(connect, "unknown component '" + end.component + "'"),
                    base::suggestion(end.component, {known.begin(), known.end()}));
}

/// All as before, and connections from that item, between components that there are.
Expectation expect_connected(const State& before, const Connect& connect, const Value& settings,
                             const std::string& path) {
  return [&before, connect, path, wanted = plain_settings(settings)](
             const State& after, base::Diagnostics& diagnostics) {
    const Node* item = added_item(*after.map, path);
    const std::set<std::string> known = names_in(after.document);
    Document others = after.document;
    const std::size_t count = others.connections.size();
    std::erase_if(others.connections, [&](const Connection& one) {
      const ConnectionEntry* entry = after.map->entry_of(one);
      if (item == nullptr || entry == nullptr || entry->item != item) return false;
      if (!has_settings(one, wanted)) {
        diagnostics.error({before.file, 0, 0}, refusal_of(connect, "it would have other settings"));
      }
      check_end(before, one.from, known, connect, diagnostics);
      check_end(before, one.to, known, connect, diagnostics);
      return true;
    });
    const bool several = has_braces(make_text(connect.from + connect.to));
    const std::size_t added = count - others.connections.size();
    if (added == 0 || (added > 1 && !several)) {
      diagnostics.error({before.file, 0, 0},
                        refusal_of(connect, added == 0 ? "no connection would come of it"
                                                       : "several connections would come of it"));
    }
    for (const std::string& other : differences(before.document, others)) {
      diagnostics.error({before.file, 0, 0}, refusal_of(connect, other + " would change"));
    }
    return after.document;
  };
}

}  // namespace

void draft(const Connect& connect, Workshop& shop) {
  const std::optional<Value> settings = connection_settings(connect.settings, shop);
  const SourceText& file = shop.file_for_new();
  if (!settings) return;
  shop.add_item_to_section(file, "connections",
                           connection_item(connect.from, connect.to, *settings));
  shop.expect(expect_connected(shop.before(), connect, *settings, file.path()));
}

}  // namespace armature::edit::internal
