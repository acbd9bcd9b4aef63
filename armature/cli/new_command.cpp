// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/new_component.hpp"

namespace armature::cli {
namespace {

int new_component(const std::string& name, const Console& console) {
  const auto made = make_component_library(name, ".");
  if (!made) {
    console.say(rt::LogLevel::kError, made.error());
    return kFailed;
  }
  for (const std::string& file : made.value().files) {
    console.print(made.value().folder + "/" + file + "\n");
  }
  console.say(rt::LogLevel::kInfo,
              "made " + made.value().folder + "; its README.md says how to build");
  return kDone;
}

}  // namespace

void add_new(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("new", "creates something to start from");
  command->require_subcommand(1);
  CLI::App* made = command->add_subcommand("component", "a component library that builds");
  const auto name = arguments_of(*made, to, new_component);
  made->add_option("name", *name, "the name of the component, such as GripperDriver")->required();
}

}  // namespace armature::cli
