// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/internal/command_line.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "armature/base/near_name.hpp"

namespace armature::cli {
namespace {

/// A misspelt folder would only be missed when a library is not found.
CLI::Validator folder() {
  const auto check = [](const std::string& text) {
    std::error_code ignored;
    if (std::filesystem::is_directory(text, ignored)) return std::string();
    return "folder '" + text + "' does not exist";
  };
  return CLI::Validator(check, "");
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> names) {
  const auto check = [names = std::move(names)](const std::string& text) {
    if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
    return "unknown value '" + text + "'" + base::suggestion_in_brackets(text, names);
  };
  return CLI::Validator(check, "");
}

void add_deployment_options(CLI::App& command, LoadArguments& load) {
  command.add_option("file", load.file, "the deployment, YAML or OROCOS XML")->required();
  command
      .add_option("--set", load.overrides, "changes a parameter or property: Joint1.GearRatio=0.02")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--mode", load.mode, "the mode to start in")->type_name("NAME");
  add_folders(command, load.library_folders);
}

void add_load_options(CLI::App& command, LoadArguments& load) {
  add_deployment_options(command, load);
  command.add_option("--times", load.times_file, "file of measured execution times, for the load");
}

void add_folders(CLI::App& command, std::vector<std::string>& folders) {
  command.add_option("-L,--library-path", folders, "folder to search for component libraries")
      ->type_name("FOLDER")
      ->check(folder())
      ->allow_extra_args(false);
}

}  // namespace armature::cli
