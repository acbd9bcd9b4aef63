// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/application_address.hpp"

#include <algorithm>
#include <utility>

#include "armature/tls/transport.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::cli {
namespace {

constexpr const char* kTls = "tls://";
constexpr const char* kWeb = "ws://";
constexpr const char* kEncryptedWeb = "wss://";
constexpr const char* kSchemes[] = {"tcp://", "unix:", kTls, kWeb, kEncryptedWeb};

std::string wrong_use_of_tls(const ApplicationAddress& application) {
  const bool all = !application.certificate.empty() && !application.key.empty() &&
                   !application.authority.empty();
  return all ? "" : "a tls:// address needs --certificate, --key and --authority";
}

std::string wrong_use_of_wss(const ApplicationAddress& application) {
  if (application.authority.empty()) return "a wss:// address needs --authority";
  const bool paired = application.certificate.empty() == application.key.empty();
  return paired ? "" : "--certificate and --key go together";
}

std::shared_ptr<ride::Transport> transport_to(const ApplicationAddress& application,
                                              base::Diagnostics& diagnostics) {
  const std::string& address = application.address;
  if (address.starts_with(kTls)) {
    return tls::make_transport({application.certificate, application.key, application.authority},
                               diagnostics);
  }
  if (address.starts_with(kWeb)) {
    return websocket::make_transport({.tokens = application.tokens}, diagnostics);
  }
  if (!address.starts_with(kEncryptedWeb)) return nullptr;
  return websocket::make_transport({.certificate = application.certificate,
                                    .key = application.key,
                                    .authority = application.authority,
                                    .tokens = application.tokens},
                                   diagnostics);
}

}  // namespace

bool is_address(const std::string& text) {
  return std::ranges::any_of(kSchemes, [&](const char* one) { return text.starts_with(one); });
}

bool is_encrypted(const ApplicationAddress& application) {
  return application.address.starts_with(kTls) || application.address.starts_with(kEncryptedWeb);
}

std::string wrong_use(const ApplicationAddress& application) {
  const std::string& address = application.address;
  if (!is_address(address)) {
    return "'" + address +
           "' is not an address: expected one such as tcp://127.0.0.1:4242, unix:/run/robot.sock, "
           "tls://robot:4243, ws://127.0.0.1:8080 or wss://robot:8443";
  }
  if (address.starts_with(kTls)) return wrong_use_of_tls(application);
  return address.starts_with(kEncryptedWeb) ? wrong_use_of_wss(application) : std::string();
}

std::vector<std::shared_ptr<ride::Transport>> transports_to(const ApplicationAddress& application,
                                                            base::Diagnostics& diagnostics) {
  std::vector<std::shared_ptr<ride::Transport>> transports;
  if (auto made = transport_to(application, diagnostics)) transports.push_back(std::move(made));
  return transports;
}

}  // namespace armature::cli
