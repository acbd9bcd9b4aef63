// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <utility>

#include "armature/browser/remote_browser.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/platform/stop_priority.hpp"
#include "armature/tls/transport.hpp"

namespace armature::cli {
namespace {

struct BrowseArguments {
  std::string address;
  std::string certificate;  ///< files in PEM form, for `tls://`
  std::string key;
  std::string authority;
};

constexpr const char* kTls = "tls://";
constexpr const char* kSchemes[] = {"tcp://", "unix:", kTls};

/// Why the arguments make no sense together; empty if they do.
std::string wrong_use(const BrowseArguments& arguments) {
  bool known = false;
  for (const char* scheme : kSchemes) known |= arguments.address.starts_with(scheme);
  if (!known) {
    return "'" + arguments.address +
           "' is not an address: expected one such as tcp://127.0.0.1:4242, unix:/run/robot.sock "
           "or "
           "tls://robot:4243";
  }
  const bool tls = arguments.address.starts_with(kTls);
  const bool all =
      !arguments.certificate.empty() && !arguments.key.empty() && !arguments.authority.empty();
  if (tls && !all) return "a tls:// address needs --certificate, --key and --authority";
  return {};
}

int browse(const BrowseArguments& arguments, const Console& console) {
  if (const std::string problem = wrong_use(arguments); !problem.empty()) {
    console.say(rt::LogLevel::kError, problem);
    return kWrongUse;
  }
  base::Diagnostics diagnostics;
  browser::RemoteBrowserOptions options;
  options.address = arguments.address;
  if (arguments.address.starts_with(kTls)) {
    const tls::Options files{arguments.certificate, arguments.key, arguments.authority};
    if (auto made = tls::make_transport(files, diagnostics)) {
      options.transports.push_back(std::move(made));
    }
  }
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
                   "tls://robot:4243")
      ->required();
  command
      ->add_option("--certificate", arguments->certificate,
                   "the certificate of this side, for tls://")
      ->type_name("FILE");
  command->add_option("--key", arguments->key, "the private key of that certificate")
      ->type_name("FILE");
  command
      ->add_option("--authority", arguments->authority,
                   "the authority that must have signed the other side's certificate")
      ->type_name("FILE");
}

}  // namespace armature::cli
