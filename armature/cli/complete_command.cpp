// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/completion.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/load.hpp"
#include "armature/component/interface.hpp"

namespace armature::cli {
namespace {

/// Mistakes in the file are for `armature check`: here what can be read is of use.
DeploymentNames names_in(const std::string& file, const Console& console) {
  LoadArguments arguments;
  arguments.file = file;
  NetworkOnDemand network(console);
  const deploy::Deployment deployment = load(arguments, network);
  DeploymentNames names;
  for (const auto& parameter : deployment.document.parameters) {
    names.parameters.push_back(parameter.name);
  }
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    const std::string& name = entry.component->name();
    names.components.push_back(name);
    for (const auto* property : component::interface_of(*entry.component).properties) {
      if (!property->persistent()) continue;  // no file says what it is
      names.properties.push_back(name + '.' + std::string(property->name()));
    }
  }
  for (const exec::ModeEntry& mode : deployment.blueprint.modes) names.modes.push_back(mode.name);
  return names;
}

}  // namespace

/// Not in the help: shells call it (packaging/completion).
void add_complete(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("complete", "what a word may become, for shells");
  command->group("");
  const auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("words", *words, "as typed, after `armature`; the last one is completed");
  command->callback([to, words] {
    to.chosen = [to, words] {
      const Console& console = to.console;
      for (const std::string& each :
           completions(to.app, *words, [&](const auto& file) { return names_in(file, console); })) {
        console.print(each + "\n");
      }
      return kDone;
    };
  });
}

}  // namespace armature::cli
