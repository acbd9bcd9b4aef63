// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/load.hpp"
#include "armature/exec/plan.hpp"

namespace armature::cli {
namespace {

struct CheckArguments {
  LoadArguments load;
  bool order = false;
  bool load_table = false;
};

int check(const CheckArguments& arguments, const Console& console) {
  NetworkOnDemand network(console);
  deploy::Deployment deployment = load(arguments.load, network);
  network.check(deployment.document, deployment.diagnostics);
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
}

}  // namespace armature::cli
