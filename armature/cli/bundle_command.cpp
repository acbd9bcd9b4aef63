// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "armature/bundle/bundle.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/load.hpp"
#include "armature/platform/child_process.hpp"
#include "armature/platform/elf/shared_object.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::cli {
namespace {

struct BundleArguments {
  LoadArguments load;
  bundle::BundleRequest request;
};

std::string absolute(const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

bundle::BundleRequest request_of(const BundleArguments& arguments,
                                 const platform::StopSignal& stop) {
  bundle::BundleRequest request = arguments.request;
  request.file = arguments.load.file;
  request.overrides = arguments.load.overrides;
  request.mode = arguments.load.mode;
  request.library_folders = arguments.load.library_folders;
  request.script = absolute(request.script);
  request.program = platform::own_program();
  request.version = ARMATURE_VERSION;
  request.stopped = [&stop] { return stop.received(); };
  return request;
}

/// Its library is loaded here and not with the program, whose runs have no use for it.
bundle::MakeBundle* make_bundle(base::Diagnostics& diagnostics) {
  const auto* const beside = reinterpret_cast<const void*>(&platform::own_program);
  const auto library =
      platform::SharedObject::load(platform::file_beside(beside, "libarmature_bundle.so"));
  void* const found = library ? library.value().symbol(bundle::kMakeBundleSymbol) : nullptr;
  if (!library) diagnostics.error({}, library.error());
  if (library && found == nullptr) {
    diagnostics.error({}, "libarmature_bundle.so is of another version: install all of it anew");
  }
  return found == nullptr ? nullptr : *static_cast<bundle::MakeBundle**>(found);
}

int run_bundle(const BundleArguments& given, const Console& console) {
  const platform::StopSignal stop;  // what is half made is removed before the end
  BundleArguments arguments = given;
  arguments.load.file = absolute(given.load.file);
  const deploy::Deployment deployment = load_and_check(arguments.load, console);
  console.show(deployment.diagnostics);
  if (!deployment.ok()) {
    console.say(rt::LogLevel::kError, given.load.file + " has errors: no bundle is made");
    return kFailed;
  }
  base::Diagnostics diagnostics;
  bundle::MakeBundle* const make = make_bundle(diagnostics);
  const std::string made =
      make == nullptr ? std::string()
                      : make(request_of(arguments, stop), deployment.document, diagnostics);
  console.show(diagnostics);
  if (made.empty()) return kFailed;
  console.say(rt::LogLevel::kInfo, "made " + made);
  return kDone;
}

}  // namespace

void add_bundle(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand(
      "bundle", "puts a deployment and all that runs it into a folder or a Debian package");
  const auto arguments = arguments_of(*command, to, run_bundle);
  add_deployment_options(*command, arguments->load);
  bundle::BundleRequest& request = arguments->request;
  command->add_option("--script", request.script, "a script in Lua that commands its runs")
      ->type_name("FILE");
  command
      ->add_option("--out", request.out,
                   "where it is made; NAME-bundle in the working directory unless given")
      ->type_name("PATH");
  command->add_flag("--deb", request.package, "a Debian package in place of a folder");
  command->add_option("--for", request.architecture, "the target's machine: amd64, arm64 or armhf")
      ->type_name("MACHINE")
      ->check(one_of({"amd64", "arm64", "armhf"}));
  command
      ->add_option("--installation", request.installation,
                   "an installed Armature for the target; that of this program unless given")
      ->type_name("FOLDER");
  command
      ->add_option(
          "--system", request.system,
          "the root of a Debian for the target, where the bundle checks itself in emulation")
      ->type_name("FOLDER");
}

}  // namespace armature::cli
