// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/replay.hpp"

namespace armature::cli {

void add_replay(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand(
      "replay", "runs what was recorded again, and says whether it is the same");
  const auto arguments = arguments_of(*command, to, replay);
  command->add_option("folder", arguments->folder, "the folder of a run, of armature run --out")
      ->required();
  command
      ->add_option("--set", arguments->changes.overrides,
                   "what if: changes a parameter or property: PID1.Kp=200")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--with", arguments->changes.file,
                   "what if: a deployment whose entries override those of the recorded one")
      ->type_name("FILE");
  command
      ->add_option("--only", arguments->only,
                   "runs these components again, alone; what others wrote to them comes from the "
                   "recording, also of a run in real time: 'Controller,PID*'")
      ->type_name("NAMES")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option_function<std::string>(
          "--until",
          [arguments](const std::string& text) {
            arguments->until = runner::parse_duration(text);
            if (!arguments->until) {
              throw CLI::ValidationError("--until",
                                         "'" + text + "' must be a time above 0, for example 3.5s");
            }
          },
          "goes no further than this time of the recording")
      ->type_name("TIME");
  command
      ->add_option("--break", arguments->breakpoints,
                   "stops where this becomes true: 'Joint1.Position > 0.3'")
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  command->add_flag("--step", arguments->step, "shows what changes, a line for each instant");
  add_folders(*command, arguments->library_folders);
  command
      ->add_option(
          "-o,--out", arguments->out,
          "the folder for what is recorded now; default: replay, or what-if, in that folder")
      ->type_name("FOLDER");
}

}  // namespace armature::cli
