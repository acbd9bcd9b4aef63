// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/libraries.hpp"
#include "armature/cli/output.hpp"
#include "armature/component/interface.hpp"
#include "armature/inspect/model_catalogue.hpp"
#include "armature/remote/interface_file.hpp"
#include "armature/types/dds_idl.hpp"

namespace armature::cli {
namespace {

struct ModelsArguments {
  std::vector<std::string> libraries;
  std::vector<std::string> library_folders;
  std::string name;
  bool json = false;
  bool dds = false;
};

bool is_interface_file(const std::string& name) {
  return name.ends_with(".idl") || name.find(".idl#") != std::string::npos;
}

/// What a deployment has of components by their interface file.
int describe_interfaces(const ModelsArguments& arguments, const Console& console) {
  base::Diagnostics diagnostics;
  std::string text;
  for (const std::string& path : remote::interfaces_of(arguments.name, diagnostics)) {
    document::Component written;
    written.name = path;
    written.interface = {path, {path, 0, 0}};
    const auto component = remote::read_interface(written, path, diagnostics);
    if (component == nullptr) continue;
    text += (text.empty() ? "" : "\n") + written.model + ": interface of " + path + "\n" +
            inspect::describe_members(*component);
  }
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  return print(text, console);
}

/// The types of all ports of models, one or all, as topics of DDS have them.
int print_dds(const component::Registry& registry, const std::string& name,
              const Console& console) {
  std::vector<std::unique_ptr<component::Component>> made;
  std::vector<const types::Type*> types;
  for (const std::string& each : name.empty() ? registry.names() : std::vector{name}) {
    const component::Registry::Model* const model = registry.find(each);
    if (model == nullptr) {
      console.say(rt::LogLevel::kError,
                  "unknown model '" + each + "' (armature models lists them)");
      return kFailed;
    }
    made.push_back(model->make(each));
    const component::Interface& interface = component::interface_of(*made.back());
    const auto add = [&](const auto& ports) {
      for (const auto* port : ports) {
        if (types::dds_objection(port->type()).empty()) types.push_back(&port->type());
      }
    };
    add(interface.inputs);
    add(interface.outputs);
  }
  return print(types::dds_idl(types), console);
}

int models(const ModelsArguments& arguments, const Console& console) {
  if (is_interface_file(arguments.name)) {
    if (!arguments.json) return describe_interfaces(arguments, console);
    console.say(rt::LogLevel::kError, "an interface file is JSON by rcidl: rcidl FILE.idl --json");
    return kWrongUse;
  }
  const auto [registry, diagnostics] = models_of(arguments.libraries, arguments.library_folders);
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  if (arguments.dds) return print_dds(registry, arguments.name, console);
  if (arguments.json) {
    std::vector<std::string> wanted;
    if (!arguments.name.empty()) wanted.push_back(arguments.name);
    return print(inspect::models_as_json(registry, wanted), console);
  }
  if (arguments.name.empty()) return print(inspect::list_models(registry), console);
  return print(inspect::describe_model(registry, arguments.name), console);
}

}  // namespace

void add_models(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("models", "lists component models, or describes one");
  const auto arguments = arguments_of(*command, to, models);
  command->add_option("name", arguments->name,
                      "the model to describe, or an interface file: ball.idl#VS");
  command->add_option("-l,--library", arguments->libraries, "component library to search")
      ->allow_extra_args(false);
  add_folders(*command, arguments->library_folders);
  auto* const json = command->add_flag("--json", arguments->json, "prints JSON, for machines");
  command
      ->add_flag("--dds", arguments->dds,
                 "prints the types of its ports, or of those of all models, as IDL for DDS")
      ->excludes(json);
}

}  // namespace armature::cli
