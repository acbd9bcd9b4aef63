// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/application_address.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/deployment_in.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/platform/child_process.hpp"
#include "armature/platform/elf/shared_object.hpp"
#include "armature/platform/stop_signal.hpp"
#include "armature/studio/server.hpp"

namespace armature::cli {
namespace {

using namespace std::chrono_literals;

struct StudioArguments {
  std::string file;
  std::vector<std::string> library_folders;
  std::string listen = "ws://127.0.0.1:8080";
  std::string policy;
  std::string certificate;
  std::string key;
  std::string authority;
  bool no_open = false;
};

/// Where programs of this account keep what they leave (XDG).
std::string state_folder() {
  if (const char* const state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    return std::string(state) + "/armature/studio";
  }
  const char* const home = std::getenv("HOME");
  return std::string(home == nullptr ? "/tmp" : home) + "/.local/state/armature/studio";
}

/// Where the build or the installation has the page.
std::string page_folder() {
  return (std::filesystem::path(platform::own_program()).parent_path() /
          "../share/armature/web/studio")
      .lexically_normal()
      .string();
}

ApplicationAddress address_of(const StudioArguments& arguments) {
  return {arguments.file, arguments.certificate, arguments.key, arguments.authority};
}

bool listens_encrypted(const StudioArguments& arguments) {
  return arguments.listen.starts_with("wss://");
}

studio::ServerOptions options_of(const StudioArguments& arguments, const Console& console,
                                 base::Diagnostics& diagnostics) {
  studio::ServerOptions options;
  options.file = arguments.file;
  options.elsewhere = is_address(arguments.file);
  options.transports = transports_to(address_of(arguments), diagnostics);
  options.listen = arguments.listen;
  options.pages = page_folder();
  options.policy = arguments.policy;
  if (listens_encrypted(arguments)) {
    options.certificate = arguments.certificate;
    options.key = arguments.key;
  }
  options.folder = state_folder();
  options.program = platform::own_program();
  for (const std::string& folder : arguments.library_folders) {
    options.arguments.insert(options.arguments.end(), {"--library-path", folder});
  }
  options.log = [&console](const rt::LogRecord& record) {
    if (record.level >= rt::LogLevel::kWarning) console.log(record);
  };
  return options;
}

/// Its library is loaded here and not with the program, whose runs have no use for it.
studio::MakeServer* make_server(base::Diagnostics& diagnostics) {
  const auto* const beside = reinterpret_cast<const void*>(&platform::own_program);
  const auto library =
      platform::SharedObject::load(platform::file_beside(beside, "libarmature_studio.so"));
  void* const found = library ? library.value().symbol(studio::kMakeServerSymbol) : nullptr;
  if (!library) diagnostics.error({}, library.error());
  if (library && found == nullptr) {
    diagnostics.error({}, "libarmature_studio.so is of another version: install all of it anew");
  }
  return found == nullptr ? nullptr : *static_cast<studio::MakeServer**>(found);
}

/// A desktop opens the page; on a machine without one the address is there to be copied.
void open_in_browser(const std::string& page) {
  const bool desktop =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!desktop || !std::filesystem::exists("/usr/bin/xdg-open")) return;
  [[maybe_unused]] const auto opened = platform::ChildProcess::start(
      {"/usr/bin/xdg-open", page}, {.log = "/dev/null", .lasting = true});
}

/// What is wrong with the address and what is given beside it; empty: nothing. Who listens for
/// others than pages and this account would let them run what they like.
std::string refusal_of(const StudioArguments& arguments) {
  const auto& address = arguments.listen;
  const bool encrypted = listens_encrypted(arguments);
  if (!encrypted && !address.starts_with("ws://") && !address.starts_with("unix:")) {
    return "'" + address +
           "' is no address for a studio: expected ws://127.0.0.1:8080, wss://0.0.0.0:8443 for "
           "other machines or, for programs of this account, unix:/run/studio.sock";
  }
  if (encrypted && (arguments.certificate.empty() || arguments.key.empty())) {
    return "'" + address + "' needs --certificate and --key";
  }
  if (encrypted && arguments.policy.empty()) {
    return "'" + address +
           "' is for other machines, too: say with --policy what their pages may do (whoever may "
           "configure 'workbench' loads libraries, which is running code)";
  }
  const bool reaches_encrypted = is_encrypted(address_of(arguments));
  if (!encrypted && !reaches_encrypted &&
      !(arguments.certificate.empty() && arguments.key.empty())) {
    return "a certificate is for wss:// addresses, and for an application at tls:// or wss://, "
           "found '" +
           address + "'";
  }
  if (!reaches_encrypted && !arguments.authority.empty()) {
    return "--authority is for an application at a tls:// or wss:// address, found '" +
           arguments.file + "'";
  }
  return {};
}

/// Likewise with what is to be opened. No file is called as if it were somewhere in a network.
std::string refusal_of_subject(const StudioArguments& arguments) {
  const bool address =
      is_address(arguments.file) || arguments.file.find("://") != std::string::npos;
  return address ? wrong_use(address_of(arguments)) : std::string();
}

int run_studio(const StudioArguments& given, const Console& console) {
  StudioArguments arguments = given;
  if (std::filesystem::is_directory(arguments.file)) {
    const auto deployment = deployment_in(arguments.file);
    if (!deployment) {
      console.say(rt::LogLevel::kError, deployment.error());
      return kWrongUse;
    }
    arguments.file = deployment.value();
  }
  for (const std::string& refusal : {refusal_of_subject(arguments), refusal_of(arguments)}) {
    if (refusal.empty()) continue;
    console.say(rt::LogLevel::kError, refusal);
    return kWrongUse;
  }
  const platform::StopSignal stop;
  base::Diagnostics diagnostics;
  studio::MakeServer* const make = make_server(diagnostics);
  const studio::ServerOptions options = options_of(arguments, console, diagnostics);
  const auto server = diagnostics.ok() ? (*make)(options, diagnostics) : nullptr;
  console.show(diagnostics);
  if (server == nullptr) return kFailed;
  for (const std::string& page : server->pages()) {
    const bool anywhere = page.starts_with("https:");
    console.say(rt::LogLevel::kInfo,
                "open " + page + " in a browser" + (anywhere ? "" : " of this machine"));
    if (!arguments.no_open) open_in_browser(page);
  }
  for (const std::string& address : server->foxglove()) {
    console.say(rt::LogLevel::kInfo, "Foxglove finds it at " + address);
  }
  while (!stop.received()) server->serve(200ms);
  if (const int process = server->running(); process != 0) {
    console.say(rt::LogLevel::kInfo, "the application goes on (process " + std::to_string(process) +
                                         "): `armature studio` finds it again");
  }
  if (options.elsewhere) {
    console.say(rt::LogLevel::kInfo, "the application at " + arguments.file + " is left as it is");
  }
  return kDone;
}

}  // namespace

void add_studio(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand(
      "studio",
      "assembles, checks, runs and watches a deployment in a browser, or watches and operates an "
      "application that runs elsewhere");
  const auto arguments = arguments_of(*command, to, run_studio);
  command
      ->add_option(
          "file", arguments->file,
          "the deployment, which need not be there yet; a folder with one deployment; or the "
          "address of an application that runs: tcp://127.0.0.1:4242, unix:/run/robot.sock, "
          "tls://robot:4243, ws://127.0.0.1:8080, wss://robot:8443")
      ->required();
  command
      ->add_option("--listen", arguments->listen,
                   "where browsers of this machine find it: ws://127.0.0.1:8080 (default); for "
                   "other machines wss://0.0.0.0:8443 with --certificate, --key and --policy")
      ->type_name("ADDRESS");
  command
      ->add_option("--certificate", arguments->certificate,
                   "what the studio proves itself with, in PEM form: at a wss:// address, which "
                   "browsers reach by the names that it is for, and to an application at tls://")
      ->type_name("FILE");
  command->add_option("--key", arguments->key, "the certificate's private key")->type_name("FILE");
  command
      ->add_option("--authority", arguments->authority,
                   "the authority that must have signed the certificate of an application at "
                   "tls://")
      ->type_name("FILE");
  command
      ->add_option("--policy", arguments->policy,
                   "who may do what; without it whoever opens the page may do everything")
      ->type_name("FILE");
  add_folders(*command, arguments->library_folders);
  command->add_flag("--no-open", arguments->no_open, "starts no browser");
}

}  // namespace armature::cli
