// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "armature/browser/remote_browser.hpp"
#include "armature/cli/application_address.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/platform/stop_priority.hpp"

namespace armature::cli {
namespace {

int browse(const ApplicationAddress& arguments, const Console& console) {
  if (const std::string problem = wrong_use(arguments); !problem.empty()) {
    console.say(rt::LogLevel::kError, problem);
    return kWrongUse;
  }
  base::Diagnostics diagnostics;
  browser::RemoteBrowserOptions options;
  options.address = arguments.address;
  options.transports = transports_to(arguments, diagnostics);
  console.show(diagnostics);
  if (!diagnostics.ok()) return kFailed;
  const platform::Promptness promptness;
  std::string problem;
  const std::size_t mistakes = browser::browse_remotely(options, problem);
  if (!problem.empty()) console.say(rt::LogLevel::kError, problem);
  return problem.empty() && mistakes == 0 ? kDone : kFailed;
}

}  // namespace

void add_browse(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand(
      "browse",
      "commands, line by line, an application that runs in another process or on another host");
  const auto arguments = arguments_of(*command, to, browse);
  command
      ->add_option("address", arguments->address,
                   "the address of the application: tcp://127.0.0.1:4242, unix:/run/robot.sock, "
                   "tls://robot:4243, ws://127.0.0.1:8080, wss://robot:8443")
      ->required();
  command
      ->add_option("--certificate", arguments->certificate,
                   "the certificate of this side, for tls:// and wss://")
      ->type_name("FILE");
  command->add_option("--key", arguments->key, "the private key of that certificate")
      ->type_name("FILE");
  command
      ->add_option("--authority", arguments->authority,
                   "the authority that must have signed the other side's certificate")
      ->type_name("FILE");
  command
      ->add_option(
          "--tokens", arguments->tokens,
          "lets this side in at ws:// and wss://: addresses of pages with their tokens, as "
          "applications say them, one a line")
      ->type_name("FILE");
}

}  // namespace armature::cli
