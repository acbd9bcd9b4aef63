// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/analysis/wiring_graph.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/load.hpp"
#include "armature/cli/output.hpp"

namespace armature::cli {
namespace {

struct GraphArguments {
  LoadArguments load;
  std::string format = "svg";
  std::string output;
  std::vector<std::string> only;  ///< components or ranges of them; none: all
  bool each_line = false;
};

int graph(const GraphArguments& arguments, const Console& console) {
  NetworkOnDemand network(console);
  const deploy::Deployment deployment = load(arguments.load, network);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) return kFailed;
  analysis::GraphOptions options{arguments.each_line, {}};
  for (const std::string& text : arguments.only) {
    const auto names = analysis::components_named(text, deployment.blueprint);
    if (!names) {
      console.say(rt::LogLevel::kError, names.error());
      return kWrongUse;
    }
    options.only.insert(options.only.end(), names.value().begin(), names.value().end());
  }
  std::string picture;
  if (arguments.format == "dot") {
    picture = analysis::graph_as_dot(deployment.blueprint, deployment.plan, options);
  } else if (arguments.format == "mermaid") {
    picture = analysis::graph_as_mermaid(deployment.blueprint, deployment.plan, options);
  } else {
    picture = analysis::graph_as_svg(deployment.blueprint, deployment.plan, options);
  }
  if (!arguments.output.empty()) {
    if (!is_no_source(arguments.output, deployment.document, console)) return kWrongUse;
    return write(arguments.output, picture, console);
  }
  return print(picture, console);
}

}  // namespace

void add_graph(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("graph", "draws the wiring");
  const auto arguments = arguments_of(*command, to, graph);
  add_load_options(*command, arguments->load);
  command->add_option("--format", arguments->format, "svg (default), dot or mermaid")
      ->check(one_of({"svg", "dot", "mermaid"}));
  command->add_option("-o,--output", arguments->output, "file to write; default: standard output");
  command
      ->add_option("--only", arguments->only,
                   "draws only these components and their neighbours: Arming,Joint{1..7}")
      ->type_name("COMPONENT[,COMPONENT]")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--each-line", arguments->each_line,
                    "draws every connection by itself, none bundled");
}

}  // namespace armature::cli
