// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/output.hpp"
#include "armature/deploy/load.hpp"
#include "armature/document/yaml.hpp"
#include "armature/orocos/deployer_file.hpp"

namespace armature::cli {
namespace {

struct ConvertArguments {
  std::string from;
  std::string to;
};

int convert(const ConvertArguments& arguments, const Console& console) {
  const auto& [from, to] = arguments;
  if (!to.ends_with(".xml") && !to.ends_with(".yaml") && !to.ends_with(".yml")) {
    console.say(
        rt::LogLevel::kError,
        "'" + to + "' must end in .yaml, .yml or .xml: the ending chooses the format to write");
    return kWrongUse;
  }
  base::Diagnostics diagnostics;
  const document::Document document = deploy::load_document(from, {}, diagnostics);
  std::string text;
  if (diagnostics.ok()) {
    text = to.ends_with(".xml") ? orocos::write_xml(document, diagnostics)
                                : document::write_yaml(document);
  }
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  if (!is_no_source(to, document, console)) return kWrongUse;
  return write(to, text, console);
}

}  // namespace

void add_convert(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("convert", "rewrites YAML as OROCOS XML and back");
  const auto arguments = arguments_of(*command, to, convert);
  command->add_option("from", arguments->from, "the deployment to read")->required();
  command->add_option("to", arguments->to, "the file to write; .xml is OROCOS XML")->required();
}

}  // namespace armature::cli
