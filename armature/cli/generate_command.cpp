// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/load.hpp"
#include "armature/generate/generate.hpp"
#include "armature/platform/child_process.hpp"
#include "armature/platform/elf/shared_object.hpp"

namespace armature::cli {
namespace {

struct GenerateArguments {
  LoadArguments load;
  std::string out;
};

/// Its library is loaded here and not with the program, whose runs have no use for it.
generate::Generate* find_generate(base::Diagnostics& diagnostics) {
  const auto* const beside = reinterpret_cast<const void*>(&platform::own_program);
  const auto library =
      platform::SharedObject::load(platform::file_beside(beside, "libarmature_generate.so"));
  void* const found = library ? library.value().symbol(generate::kGenerateSymbol) : nullptr;
  if (!library) diagnostics.error({}, library.error());
  if (library && found == nullptr) {
    diagnostics.error({}, "libarmature_generate.so is of another version: install all of it anew");
  }
  return found == nullptr ? nullptr : *static_cast<generate::Generate**>(found);
}

int run_generate(const GenerateArguments& given, const Console& console) {
  LoadArguments load = given.load;
  load.file = std::filesystem::absolute(load.file).lexically_normal().string();
  const deploy::Deployment deployment = load_and_check(load, console);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) {
    console.say(rt::LogLevel::kError, given.load.file + " has errors: no program is generated");
    return kFailed;
  }
  base::Diagnostics diagnostics;
  generate::Generate* const generate = find_generate(diagnostics);
  const std::string made =
      generate == nullptr
          ? std::string()
          : generate({load.file, load.library_folders, given.out}, deployment, diagnostics);
  console.show(diagnostics);
  if (made.empty()) return kFailed;
  console.say(rt::LogLevel::kInfo, "generated " + made);
  return kDone;
}

}  // namespace

void add_generate(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand(
      "generate", "writes a deployment as a program in C++, for small boards");
  const auto arguments = arguments_of(*command, to, run_generate);
  add_deployment_options(*command, arguments->load);
  command
      ->add_option("--out", arguments->out,
                   "the folder of its sources; NAME-program in the working directory unless given")
      ->type_name("FOLDER");
}

}  // namespace armature::cli
