// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/load.hpp"
#include "armature/document/document.hpp"
#include "armature/edit/source_text.hpp"

namespace armature::edit {

/// A component as a file has it: what is behind all those that a range or a composite makes of it.
struct Entry {
  const SourceText* file = nullptr;
  const Node* key = nullptr;
  const Node* value = nullptr;
  std::string composite;           ///< in whose definition it stands; empty: none
  std::vector<std::string> names;  ///< full names of what the document has of it
  bool changes = false;            ///< it changes another entry: override: true, remove: true
};

/// A connection as a file has it.
struct ConnectionEntry {
  const SourceText* file = nullptr;
  const Node* item = nullptr;
  std::string composite;  ///< in whose definition it stands; empty: none
};

/// What stands where in the files of a deployment.
class SourceMap {
 public:
  /// @param path      the deployment's file, YAML
  /// @param read      gives the files that `document` was read from
  /// @param document  without errors
  SourceMap(const std::string& path, const deploy::FileReader& read,
            const document::Document& document, base::Diagnostics& diagnostics);

  const SourceText& main() const { return *files_.back(); }
  /// nullptr if it is none of them, or not YAML.
  const SourceText* file(std::string_view path) const;
  /// Included ones before those that include them: the last word counts. Without OROCOS files.
  const std::vector<std::unique_ptr<SourceText>>& files() const { return files_; }

  /// In the order in which their words count.
  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<ConnectionEntry>& connections() const { return connections_; }

  /// Entries behind a component or composite: the one that makes it, then what changes it.
  std::vector<const Entry*> entries_of(std::string_view name) const;

  /// The entry of a connection in the document; nullptr if it is in an OROCOS file.
  const ConnectionEntry* entry_of(const document::Connection& connection) const;
  const ConnectionEntry* entry_of(const document::NamedConnection& connection) const;

 private:
  void add_file(const std::string& path, const deploy::FileReader& read,
                const document::Document& document, base::Diagnostics& diagnostics);
  void add_components(const SourceText& file, const Node* components, const std::string& composite,
                      const document::Document& document);
  void add_connections(const SourceText& file, const Node* connections,
                       const std::string& composite);
  const ConnectionEntry* connection_at(const base::Location& where) const;

  std::map<std::string, std::vector<std::string>> made_at_;  ///< names, by the place of the entry
  std::vector<std::string> seen_;
  std::vector<std::unique_ptr<SourceText>> files_;
  std::vector<Entry> entries_;
  std::vector<ConnectionEntry> connections_;
  std::map<std::string, std::size_t> connection_places_;
};

/// The path under which the reader of a deployment asks for `path`.
std::string normal_path(const std::string& path);

/// True for the names of OROCOS files.
bool is_orocos_file(const std::string& path);

}  // namespace armature::edit
