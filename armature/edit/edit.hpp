// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/load.hpp"
#include "armature/document/limits.hpp"
#include "armature/edit/replacement.hpp"

/// Edits of deployments as edits of their text: every byte that an edit is not about stays. Only
/// `save_files` knows a disk; the others read through the reader that they are given.
namespace armature::edit {

/// `path` is the name of a parameter; `Component.Property`, where the component may be as a file
/// has it (`Joint{1..3}`) and the property inside others (`Gains.Kp`); `Component.activity`, or
/// `Component.activity.priority`. `value` is YAML.
struct Set {
  std::string path;
  std::string value;
};

/// Takes back what a file says there; what another file says, or the default, is seen then.
struct Unset {
  std::string path;
};

/// A component, or a composite of the file; of no properties yet.
struct AddComponent {
  std::string name;
  std::string model;
};

/// With its connections and all that refers to it: peers, modes, grants, exports.
struct RemoveComponent {
  std::string name;
};

/// In all that refers to it. A range keeps its numbers: `Joint{1..3}` becomes `Axis{1..3}`.
struct Rename {
  std::string from;
  std::string to;
};

/// An entry that speaks for several, `Joint{1..7}`, becomes up to three: those before `part`, the
/// part, `3` or `3..5`, and those behind it. The application stays as it is.
struct Split {
  std::string name;
  std::string part;
};

/// Components of a file, as it has them, become the parts of a composite of which there is one
/// instance. Definition and instance have that name; the plan stays the same up to names.
struct Group {
  std::string name;
  std::vector<std::string> parts;
};

/// The parts of a composite's instance become components beside it. Its definition goes with its
/// last instance.
struct Dissolve {
  std::string name;
};

/// Two ports, or an event and a command.
struct Connect {
  std::string from;
  std::string to;
  std::string
      settings{};  ///< further keys, YAML: `policy: {fifo: 8}, max_age: 30 ms`, `name: Trip`
};

/// Ends as the file or the document has them; `to` is empty for one that `from` names.
struct Disconnect {
  std::string from;
  std::string to;
};

/// A connection that is there has these settings and no others; none: it is a plain one.
struct SetConnection {
  std::string from;
  std::string to;
  std::string settings{};  ///< as those of Connect
};

/// Which operation or event of a peer serves one that the component requires.
struct Bind {
  std::string component;
  std::string name;    ///< what it requires
  std::string target;  ///< `Peer.member`
};

/// The requirement is served by the only peer that can.
struct Unbind {
  std::string component;
  std::string name;
};

/// A component that another one may use.
struct AddPeer {
  std::string component;
  std::string peer;
};

/// It is a peer no longer; `peer` is its name in the file.
struct RemovePeer {
  std::string component;
  std::string peer;
};

/// A peer that commands the component, and that it uses nevertheless.
struct AddSuperior {
  std::string component;
  std::string superior;
};

/// It is a superior no longer; `superior` is its name in the file.
struct RemoveSuperior {
  std::string component;
  std::string superior;
};

/// What a component calls that calls what it is told. Calls that are there already stay as they are
/// written, with their comments.
struct SetCalls {
  std::string component;
  std::string calls;  ///< YAML: a list, or one call; `[]`: none
};

/// A file whose entries are the deployment's, too; relative to the file that includes it.
struct AddInclude {
  std::string file;
};

/// With what that file says, and no other does.
struct RemoveInclude {
  std::string file;  ///< as it is named
};

/// A parameter that no file has yet.
struct AddParameter {
  std::string name;
  std::string value;  ///< YAML
};

/// A component library, by its name or file.
struct AddLibrary {
  std::string name;
};

/// Its components stay, and are mistakes then.
struct RemoveLibrary {
  std::string name;
};

/// A component, or a range of them, runs in that mode; the mode is made if there is none.
struct AddToMode {
  std::string mode;
  std::string component;
};

/// It stands in the mode no longer. What stands in no mode then runs in all: a warning says so.
struct RemoveFromMode {
  std::string mode;
  std::string component;
};

/// Its components stay.
struct RemoveMode {
  std::string name;
};

/// Also where the file says in which mode the application starts.
struct RenameMode {
  std::string from;
  std::string to;
};

/// The application starts in that mode, unless it is told otherwise.
struct StartInMode {
  std::string name;
};

using Change =
    std::variant<Set, Unset, AddComponent, RemoveComponent, Rename, Split, Group, Dissolve, Connect,
                 Disconnect, SetConnection, Bind, Unbind, AddPeer, RemovePeer, AddSuperior,
                 RemoveSuperior, SetCalls, AddInclude, RemoveInclude, AddParameter, AddLibrary,
                 RemoveLibrary, AddToMode, RemoveFromMode, RemoveMode, RenameMode, StartInMode>;

/// For messages: `set Filter.Weight`.
std::string to_text(const Change& change);

/// A change, and where it may be written. Unless told otherwise that is the deployment's own file
/// only, and what another one says is not changed.
struct Edit {
  Change change;
  /// Included files that it may change; what is new comes into the first of them.
  std::vector<std::string> files{};
  /// What an included file or a range says stays, and the deployment's own file overrides it.
  bool overrides = false;
};

/// What becomes of a file.
struct FileChange {
  std::string file;
  std::string before;
  std::string after;
  std::vector<Replacement> replacements;  ///< make `after` of `before`
  std::vector<Replacement> inverse;       ///< make `before` of `after`
};

/// What edits make of a deployment: all of them, or with errors nothing.
struct Outcome {
  std::vector<FileChange> files;
  base::Diagnostics diagnostics;

  bool ok() const { return diagnostics.ok(); }
};

/// Makes the edits one after the other. Each is proved: its text is read anew, and the document
/// must have changed by what is meant and nothing else.
/// @param file  the deployment, YAML; one that has mistakes is refused
/// @param read  gives the text of it and of the files it includes, under their normal paths
/// @return with errors, which say why an edit is refused, no files
Outcome apply_edits(const std::string& file, const std::vector<Edit>& edits,
                    const deploy::FileReader& read, const document::Limits& limits = {});

}  // namespace armature::edit
