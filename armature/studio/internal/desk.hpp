// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/studio/internal/checker.hpp"
#include "armature/studio/internal/journal.hpp"
#include "armature/studio/internal/project.hpp"
#include "armature/studio/internal/run.hpp"

namespace armature::studio::internal {

/// What everybody who has the studio open works on: the texts of a deployment, what the check finds
/// in them, and its run.
/// @thread one
class Desk {
 public:
  struct Options {
    std::string file;
    std::string program;                 ///< `armature`
    std::vector<std::string> arguments;  ///< behind the file's name: `--library-path X`, ...
    std::string folder;                  ///< of this deployment, for what a studio leaves
  };
  /// Called when something that the Desk tells of is other than before.
  struct Listeners {
    std::function<void()> project;
    std::function<void()> run;
  };

  Desk(const Options& options, Listeners listeners);

  const Project& project() const { return project_; }
  const Run& run() const { return run_; }
  Run& run() { return run_; }
  /// What the user must know of the files; empty: nothing.
  const std::string& notice() const { return notice_; }
  /// The version that `findings` is about; 0: nothing was checked yet.
  std::int32_t checked() const { return checked_; }
  /// The last check, JSON; empty: there was none.
  const std::string& findings() const { return findings_; }

  base::Diagnostics edit(const std::vector<WordedChange>& changes,
                         const std::vector<std::string>& files, bool overrides);
  base::Result<void> write(std::int32_t version, const std::string& path, const std::string& text);
  base::Result<void> undo();
  base::Result<void> redo();
  base::Result<void> save();
  /// Takes what the disk has, component libraries that were built anew among it.
  base::Result<void> reload();
  void ask_fitting(const std::string& component, const std::string& member, Checker::Then then);
  void ask_models(Checker::Then then);

  /// @param order  its version is set
  base::Result<void> start(RunOrder order);
  /// It was asked to stop.
  void tell_of_run() { listeners_.run(); }

  /// Whose descriptor is to be waited for, and whose answers are to be taken.
  Checker& checker() { return checker_; }
  /// Looks after the run, some ten times a second.
  void look_at_run();
  /// Looks whether others have changed files, about once a second.
  void look_at_disk();

 private:
  base::Result<void> told(base::Result<void> result);
  void after_change();
  void check();
  void take_findings(std::int32_t version, base::Result<std::string> result);

  const Options options_;
  const Listeners listeners_;
  Project project_;
  Journal journal_;
  Checker checker_;
  Run run_;
  std::string notice_;
  std::string findings_;
  std::int32_t known_version_ = 0;
  std::int32_t checked_ = 0;
  bool checking_ = false;
};

}  // namespace armature::studio::internal
