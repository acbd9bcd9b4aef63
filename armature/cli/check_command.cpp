// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/cli/check_service.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/load.hpp"
#include "armature/exec/plan.hpp"
#include "armature/inspect/checked_json.hpp"
#include "armature/platform/file.hpp"

namespace armature::cli {
namespace {

struct CheckArguments {
  LoadArguments load;
  bool order = false;
  bool load_table = false;
  bool json = false;
  bool serve = false;
};

int print_json(const deploy::Deployment& deployment, const std::string& file,
               const Console& console) {
  inspect::CheckedForm form;
  form.read = [](const std::string& path) { return platform::read_file(path); };
  console.print(inspect::checked_as_json(
      {file, deployment.diagnostics, deployment.blueprint, deployment.plan}, form));
  return deployment.ok() ? kDone : kFailed;
}

/// Answers until its input ends.
int serve(const CheckArguments& arguments, const Console& console) {
  CheckService service(arguments.load.library_folders,
                       [&](const LoadArguments& load, deploy::FileReader read) {
                         return load_and_check(load, console, std::move(read));
                       });
  std::string line;
  while (std::getline(std::cin, line)) {
    console.print(service.answer(line));
    std::fflush(stdout);
  }
  return kDone;
}

int check(const CheckArguments& arguments, const Console& console) {
  if (arguments.serve) return serve(arguments, console);
  if (arguments.load.file.empty()) {
    console.say(rt::LogLevel::kError, "file is required; armature check --help says more");
    return kWrongUse;
  }
  const deploy::Deployment deployment = load_and_check(arguments.load, console);
  if (arguments.json) return print_json(deployment, arguments.load.file, console);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) {
    const std::size_t errors = deployment.diagnostics.error_count();
    console.say(rt::LogLevel::kError, arguments.load.file + ": " + std::to_string(errors) +
                                          (errors == 1 ? " error" : " errors"));
    return kFailed;
  }
  if (arguments.order) {
    console.print(exec::describe_order(deployment.blueprint, deployment.plan));
  }
  if (arguments.load_table) console.print(deployment.schedule.to_text());
  console.say(rt::LogLevel::kInfo,
              arguments.load.file + ": " + std::to_string(deployment.blueprint.components.size()) +
                  " components, " + std::to_string(deployment.plan.connections.size()) +
                  " connections, no errors");
  return kDone;
}

}  // namespace

void add_check(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("check", "finds every mistake without running");
  const auto arguments = arguments_of(*command, to, check);
  add_load_options(*command, arguments->load);
  command->add_flag("--order", arguments->order, "prints which thread runs what, in which order");
  command->add_flag("--load", arguments->load_table, "prints the load of each thread");
  command->add_flag("--json", arguments->json, "prints all that is known, for machines");
  CLI::Option* const serve =
      command->add_flag("--serve", arguments->serve,
                        "answers an editor: requests in JSON, a line each, on standard input");
  command->get_option("file")->required(false)->excludes(serve);
}

}  // namespace armature::cli
