// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/run.hpp"

namespace armature::cli {
namespace {

/// With what is told by words.
struct RunOptions {
  RunArguments run;
  std::string realtime = "prefer";
  std::string guard;
};

RunArguments chosen_by(const RunOptions& options, const std::vector<std::string>& words) {
  RunArguments run = options.run;
  run.command_line = words;
  if (options.realtime == "off") run.realtime = exec::RealtimeMode::kOff;
  if (options.realtime == "require") run.realtime = exec::RealtimeMode::kRequire;
  if (options.guard == "report") run.guard = rt::GuardMode::kReport;
  if (options.guard == "abort") run.guard = rt::GuardMode::kAbort;
  return run;
}

}  // namespace

void add_run(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("run", "runs a deployment until stopped (Ctrl-C)");
  const auto options = std::make_shared<RunOptions>();
  RunArguments& run = options->run;
  add_load_options(*command, run.load);
  CLI::Option* const simulated =
      command->add_flag("--sim", run.simulated, "runs in simulated time, as fast as possible");
  command
      ->add_option("--pace", run.rate,
                   "simulated seconds in a second: 1 is real time, 0.1 a tenth of it")
      ->type_name("RATE")
      ->check(CLI::Validator(CLI::PositiveNumber).description(""))
      ->needs(simulated);
  command
      ->add_option_function<std::string>(
          "--for",
          [options](const std::string& text) {
            options->run.duration = runner::parse_duration(text);
            if (!options->run.duration) {
              throw CLI::ValidationError(
                  "--for", "'" + text + "' must be a duration above 0, for example 10s");
            }
          },
          "how long it runs, for example 10s or 500ms")
      ->type_name("TIME");
  CLI::Option* const script =
      command->add_option("--script", run.script, "commands it with a script in Lua");
  script->type_name("FILE");
  command->add_flag("--browse", run.browse, "commands it line by line: the task browser")
      ->excludes(script);
  command
      ->add_option(
          "--listen", run.listen,
          "address at which other processes reach it: tcp://127.0.0.1:4242, unix:/run/robot.sock")
      ->type_name("ADDRESS")
      ->allow_extra_args(false);
  command
      ->add_option("--policy", run.policy,
                   "who else may do what, beside those whom the deployment's policy allows")
      ->type_name("FILE");
  command
      ->add_option("--tokens", run.tokens,
                   "lets it in at ws:// and wss://: addresses of pages with their tokens, as other "
                   "applications say them, one a line")
      ->type_name("FILE");
  command->add_option("--realtime", options->realtime, "off, prefer (default) or require")
      ->check(one_of({"off", "prefer", "require"}))
      ->type_name("MODE");
  command
      ->add_flag("--guard{report}", options->guard,
                 "watches real-time threads for allocation, locks and I/O; --guard=abort ends at "
                 "the first")
      ->check(one_of({"report", "abort"}));
  command->add_option("--write-times", run.write_times, "writes measured execution times");
  command
      ->add_option("--out", run.output_folder,
                   "the folder for recordings; created if it is missing")
      ->type_name("FOLDER");
  command->add_option("--trace", run.trace, "writes the timeline of all threads, for Perfetto")
      ->type_name("FILE");
  command->add_flag("--statistics", run.statistics, "prints cycles and latencies at the end");
  command->callback([to, options] {
    to.chosen = [to, options] { return cli::run(chosen_by(*options, to.words), to.console); };
  });
}

}  // namespace armature::cli
