// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/deploy/load.hpp"
#include "armature/edit/edit.hpp"
#include "armature/studio/internal/rebase.hpp"

namespace armature::studio::internal {

/// A text of a deployment.
struct ProjectFile {
  std::string text;  ///< as the studio has it
  std::string disk;  ///< as it was read or written last; empty also if there is no such file

  bool is_changed() const { return text != disk; }
};

/// The texts of files that differ from the disk, with what the disk had.
using Unsaved = std::map<std::string, ProjectFile>;

/// An edit by its name and words, as workbench.idl lists them, `place` among them.
struct WordedChange {
  std::string edit;
  std::vector<std::string> words;
};

/// The texts of a deployment while they are edited: its own file, those it includes, and the file
/// with the places of its boxes. All changes are steps that can be taken back. Everything is in
/// memory: `Disk` reads and writes.
class Project {
 public:
  /// The files as they are on disk.
  struct Disk {
    /// An empty text if there is no such file; the error says why it cannot be read.
    deploy::FileReader read;
    std::function<base::Result<void>(const std::vector<edit::FileChange>&)> save;
  };
  static constexpr std::size_t kMostSteps = 1000;

  /// @param file  the deployment; it need not be there yet
  Project(std::string file, Disk disk);

  const std::string& file() const { return file_; }
  /// Of the file with the places of boxes.
  std::string places_file() const { return file_ + ".studio.json"; }
  /// Grows with each change of a text.
  std::int32_t version() const { return version_; }
  const std::map<std::string, ProjectFile>& files() const { return files_; }
  /// nullptr if it is none of the project's.
  const std::string* text(const std::string& path) const;
  bool is_saved() const { return unsaved().empty(); }
  Unsaved unsaved() const;
  /// What would be taken back, and done again; empty: nothing.
  std::string undo_text() const { return done_.empty() ? "" : done_.back().text; }
  std::string redo_text() const { return undone_.empty() ? "" : undone_.back().text; }

  /// Makes all of them, or after an error none.
  /// @param files, overrides  as for edit::Edit
  base::Diagnostics edit(const std::vector<WordedChange>& changes,
                         const std::vector<std::string>& files, bool overrides);
  /// @param text  what became of the file's text of `version`; what others changed since stays
  base::Result<void> write(std::int32_t version, const std::string& path, const std::string& text);
  /// The error: there is nothing.
  base::Result<void> undo();
  base::Result<void> redo();
  /// Writes what is changed: all files or none.
  base::Result<void> save();
  /// Takes what the disk has now, as a step.
  void reload();
  /// Takes over what others have changed on the disk since it was read.
  /// @return what the user must know: what was taken over, and where both changed the same, which
  ///   is left as it is; empty: nothing
  std::string take_from_disk();
  /// Texts that an earlier studio had and did not save, as a step.
  /// @return what the user must know
  std::string restore(const Unsaved& unsaved);

  /// Of what the studio has: those of the project in memory, others from disk.
  deploy::FileReader reader();

 private:
  /// A change of a file, without its texts: a thousand of them are kept.
  struct Delta {
    std::string file;
    Replacements forward;
    Replacements back;
  };
  struct Step {
    std::string text;
    std::vector<Delta> files;
  };
  /// What a version changed, by which texts of earlier ones are found again.
  struct Made {
    std::int32_t version;
    std::vector<Delta> files;
  };

  void find_files();
  void load(const std::string& path);
  void apply(const std::vector<Delta>& files);
  void add_step(std::string text, std::vector<Delta> files);
  void replace_text(std::string step, const std::string& path, const std::string& text);
  static std::vector<Delta> backwards(const std::vector<Delta>& files);
  Delta change_to(const std::string& path, const std::string& text) const;
  /// What others made of a file since `version`, one after the other.
  std::vector<const Delta*> made_since(std::int32_t version, const std::string& path) const;
  base::Result<Delta> placed(const std::vector<WordedChange>& changes,
                             base::Diagnostics& diagnostics) const;
  bool merge(const std::string& path, const std::string& now);

  const std::string file_;
  const Disk disk_;
  std::int32_t version_ = 1;
  std::map<std::string, ProjectFile> files_;
  std::vector<Step> done_;
  std::vector<Step> undone_;
  std::deque<Made> made_;
  std::map<std::string, std::string> told_conflicts_;  ///< texts of the disk, by path
};

}  // namespace armature::studio::internal
