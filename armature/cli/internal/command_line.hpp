// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "armature/cli/arguments.hpp"
#include "armature/cli/console.hpp"

namespace armature::cli {

/// What each command adds itself to.
struct CommandLine {
  CLI::App& app;
  Console& console;
  const std::vector<std::string>& words;  ///< as typed
  std::function<int()>& chosen;           ///< becomes the command to execute; gives the exit code
};

/// What a command was given; once chosen, it executes with that.
template <typename Arguments, typename Output>
std::shared_ptr<Arguments> arguments_of(CLI::App& command, const CommandLine& to,
                                        int (*execute)(const Arguments&, Output&)) {
  const auto arguments = std::make_shared<Arguments>();
  command.callback([to, arguments, execute] {
    to.chosen = [to, arguments, execute] { return execute(*arguments, to.console); };
  });
  return arguments;
}

/// Refuses what is not in `names` with the nearest, or all of them.
CLI::Validator one_of(std::vector<std::string> names);

/// Of a command that loads a deployment.
void add_deployment_options(CLI::App& command, LoadArguments& load);

/// Likewise, and of one that tells its load.
void add_load_options(CLI::App& command, LoadArguments& load);

/// Where component libraries are looked for.
void add_folders(CLI::App& command, std::vector<std::string>& folders);

}  // namespace armature::cli
