// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::replay {

/// Its name in the folder of a run.
inline constexpr const char* kExperimentFile = "experiment.json";

/// A component library that a run used.
struct UsedLibrary {
  std::string name;  ///< as the deployment has it
  std::string file;
  std::string hash;  ///< of its content
};

/// What a run was, so that it can be done again: all that it read, and with which program. What was
/// done to it while it ran is in `kActsFile`.
struct Experiment {
  std::string version;     ///< of Armature
  std::string folder;      ///< in which the program ran: relative paths begin there
  std::string deployment;  ///< its file, as it was given
  std::string application;
  bool simulated = false;
  std::vector<std::string> overrides;
  std::string mode;
  std::vector<std::string> library_folders;
  std::vector<UsedLibrary> libraries;
  std::map<std::string, std::string> texts;  ///< of the deployment and what it includes, by path
  std::map<std::string, std::string> named;  ///< paths, by the properties that have them
  std::map<std::string, std::string> files;  ///< that these paths lead to; small texts only
  /// Of properties that name files which components change: texts by their names in the folder that
  /// the property names; by "" of the file that it names.
  using Contents = std::map<std::string, std::string>;
  std::map<std::string, Contents> own;
  std::string outline;  ///< runner::outline of what ran
};

base::Result<void> write_experiment(const std::string& folder, const Experiment& experiment);

/// The error says what the folder of a run has, and what was found.
base::Result<Experiment> load_experiment(const std::string& folder);

/// As `load_experiment`, of the text of its file.
/// @param path  for errors
base::Result<Experiment> parse_experiment(std::string_view text, const std::string& path);

}  // namespace armature::replay
