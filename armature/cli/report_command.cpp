// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/report/report.hpp"

namespace armature::cli {
namespace {

struct ReportArguments {
  std::string folder;
  std::string page;  ///< empty: beside the recordings
};

int report(const ReportArguments& arguments, const Console& console) {
  if (!arguments.page.empty() && !arguments.page.ends_with(".html")) {
    console.say(rt::LogLevel::kError,
                "--out must name a page that ends in .html, found '" + arguments.page + "'");
    return kWrongUse;
  }
  base::Diagnostics diagnostics;
  const report::Written written =
      report::write_report({arguments.folder, arguments.page}, diagnostics);
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  console.say(rt::LogLevel::kInfo, "wrote " + written.page + " and " + written.figures);
  return kDone;
}

}  // namespace

void add_report(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("report", "shows recorded runs as one HTML page");
  const auto arguments = arguments_of(*command, to, report);
  command->add_option("folder", arguments->folder, "the folder of a run, or of several runs")
      ->required();
  command
      ->add_option("--out", arguments->page,
                   "the page to write; default: report.html in that folder")
      ->type_name("FILE");
}

}  // namespace armature::cli
