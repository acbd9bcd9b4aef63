// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/edit/edit.hpp"
#include "armature/edit/internal/layout.hpp"
#include "armature/edit/source_map.hpp"

namespace armature::edit::internal {

/// A deployment as its files are now.
struct State {
  std::string file;
  std::map<std::string, std::string> texts;  ///< of its files
  document::Limits limits;
  document::Document document;
  std::unique_ptr<SourceMap> map;

  /// With what the command line would set: `Joint1.Gain=2`; an empty document with errors.
  document::Document with(const std::vector<std::string>& settings) const;
};

/// Reads it; errors if it has mistakes.
State read_state(const std::string& file, const deploy::FileReader& read,
                 const document::Limits& limits, base::Diagnostics& diagnostics);

/// `set A.N is refused: REASON`.
std::string refusal_of(const Change& change, const std::string& reason);

/// Given the document after an edit, the one that it should be: from the one before by what is
/// meant. Where the edit is not what was meant it adds errors.
using Expectation =
    std::function<document::Document(const State& after, base::Diagnostics& diagnostics)>;

/// One edit while it is made: its text in the files, and what is to become of the document.
class Workshop {
 public:
  Workshop(const State& before, const Edit& edit, base::Diagnostics& diagnostics)
      : before_(before), edit_(edit), diagnostics_(diagnostics) {}

  const State& before() const { return before_; }
  const document::Document& document() const { return before_.document; }
  const SourceMap& map() const { return *before_.map; }
  bool overrides() const { return edit_.overrides; }

  /// Whether the edit may change the file.
  bool may_change(const SourceText& file) const;
  /// Likewise; an error that says how to allow it.
  bool require(const SourceText& file, const Node& node, const std::string& what);

  /// The file for what is new: the first of those given, or the deployment's own.
  const SourceText& file_for_new() const;

  Layout& layout(const SourceText& file);

  /// An entry of a section of that file; the section is made if need be.
  void add_to_section(const SourceText& file, const std::string& section, const std::string& key,
                      const document::Value& value, int levels);
  /// A key of the file's own map that it does not have yet.
  void add_section(const SourceText& file, const std::string& section,
                   const document::Value& content, int levels);
  /// An item of a section that is a list.
  void add_item_to_section(const SourceText& file, const std::string& section,
                           const document::Value& item);

  void refuse(const base::Location& where, const std::string& reason, const base::Hint& hint = {});
  void refuse(const std::string& reason, const base::Hint& hint = {});
  bool ok() const { return diagnostics_.ok(); }
  base::Diagnostics& diagnostics() { return diagnostics_; }
  const Edit& edit() const { return edit_; }

  void expect(Expectation expectation) { expectation_ = std::move(expectation); }
  const Expectation& expectation() const { return expectation_; }

  /// By file, once all has been drafted.
  std::map<std::string, std::vector<Replacement>> take();

 private:
  const State& before_;
  const Edit& edit_;
  base::Diagnostics& diagnostics_;
  std::map<const SourceText*, Layout> layouts_;
  Expectation expectation_;
};

// Each drafts the text of its change, and says what it expects of the document.
void draft(const Set& set, Workshop& shop);
void draft(const Unset& unset, Workshop& shop);
void draft(const AddComponent& add, Workshop& shop);
void draft(const RemoveComponent& remove, Workshop& shop);
void draft(const Rename& rename, Workshop& shop);
void draft(const Split& split, Workshop& shop);
void draft(const Group& group, Workshop& shop);
void draft(const Dissolve& dissolve, Workshop& shop);
void draft(const Connect& connect, Workshop& shop);
void draft(const Disconnect& disconnect, Workshop& shop);
void draft(const SetConnection& set, Workshop& shop);
void draft(const Bind& bind, Workshop& shop);
void draft(const Unbind& unbind, Workshop& shop);
void draft(const AddPeer& add, Workshop& shop);
void draft(const RemovePeer& remove, Workshop& shop);
void draft(const AddSuperior& add, Workshop& shop);
void draft(const RemoveSuperior& remove, Workshop& shop);
void draft(const SetCalls& set, Workshop& shop);
void draft(const AddInclude& add, Workshop& shop);
void draft(const RemoveInclude& remove, Workshop& shop);
void draft(const AddParameter& add, Workshop& shop);
void draft(const AddLibrary& add, Workshop& shop);
void draft(const RemoveLibrary& remove, Workshop& shop);
void draft(const AddToMode& add, Workshop& shop);
void draft(const RemoveFromMode& remove, Workshop& shop);
void draft(const RemoveMode& remove, Workshop& shop);
void draft(const RenameMode& rename, Workshop& shop);
void draft(const StartInMode& start, Workshop& shop);

/// What differs between two documents, places aside: `component 'Joint1'`. Components that only one
/// of them has may be anywhere; the order of the others counts.
std::vector<std::string> differences(const document::Document& expected,
                                     const document::Document& found);

}  // namespace armature::edit::internal
