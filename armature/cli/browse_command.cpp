// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <utility>

#include "armature/browser/remote_browser.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/platform/stop_priority.hpp"
#include "armature/tls/transport.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::cli {
namespace {

struct BrowseArguments {
  std::string address;
  std::string certificate;  ///< files in PEM form, for `tls://` and `wss://`
  std::string key;
  std::string authority;
  std::string tokens;  ///< a file, for `ws://` and `wss://`
};

constexpr const char* kTls = "tls://";
constexpr const char* kWeb = "ws://";
constexpr const char* kEncryptedWeb = "wss://";
constexpr const char* kSchemes[] = {"tcp://", "unix:", kTls, kWeb, kEncryptedWeb};

/// Why the arguments make no sense together; empty if they do.
std::string wrong_use(const BrowseArguments& arguments) {
  bool known = false;
  for (const char* scheme : kSchemes) known |= arguments.address.starts_with(scheme);
  if (!known) {
    return "'" + arguments.address +
           "' is not an address: expected one such as tcp://127.0.0.1:4242, unix:/run/robot.sock, "
           "tls://robot:4243, ws://127.0.0.1:8080 or wss://robot:8443";
  }
  const bool tls = arguments.address.starts_with(kTls);
  const bool all =
      !arguments.certificate.empty() && !arguments.key.empty() && !arguments.authority.empty();
  if (tls && !all) return "a tls:// address needs --certificate, --key and --authority";
  const bool web = arguments.address.starts_with(kEncryptedWeb);
  if (web && arguments.authority.empty()) return "a wss:// address needs --authority";
  if (web && arguments.certificate.empty() != arguments.key.empty()) {
    return "--certificate and --key go together";
  }
  return {};
}

/// What the address needs beside TCP and sockets of this machine.
std::shared_ptr<ride::Transport> transport_for(const BrowseArguments& arguments,
                                               base::Diagnostics& diagnostics) {
  const std::string& address = arguments.address;
  if (address.starts_with(kTls)) {
    return tls::make_transport({arguments.certificate, arguments.key, arguments.authority},
                               diagnostics);
  }
  if (address.starts_with(kWeb)) {
    return websocket::make_transport({.tokens = arguments.tokens}, diagnostics);
  }
  if (!address.starts_with(kEncryptedWeb)) return nullptr;
  return websocket::make_transport({.certificate = arguments.certificate,
                                    .key = arguments.key,
                                    .authority = arguments.authority,
                                    .tokens = arguments.tokens},
                                   diagnostics);
}

int browse(const BrowseArguments& arguments, const Console& console) {
  if (const std::string problem = wrong_use(arguments); !problem.empty()) {
    console.say(rt::LogLevel::kError, problem);
    return kWrongUse;
  }
  base::Diagnostics diagnostics;
  browser::RemoteBrowserOptions options;
  options.address = arguments.address;
  if (auto made = transport_for(arguments, diagnostics)) {
    options.transports.push_back(std::move(made));
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
