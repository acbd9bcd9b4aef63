// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/transport.hpp"

#include <mutex>
#include <optional>
#include <utility>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/tls/server_files.hpp"
#include "armature/tls/transport.hpp"
#include "armature/websocket/internal/client.hpp"
#include "armature/websocket/internal/handshake.hpp"
#include "armature/websocket/internal/pages.hpp"
#include "armature/websocket/internal/server.hpp"
#include "armature/websocket/internal/tokens.hpp"

namespace armature::websocket {
namespace {

using ride::Address;

bool is_encrypted(const Options& options) {
  return !options.certificate.empty() || !options.authority.empty();
}

/// What it connects with and by; no `under`: it connects to nobody.
struct ClientSide {
  std::shared_ptr<ride::Transport> under;
  internal::Tokens tokens;
};

class WebTransport final : public Transport {
 public:
  /// @param pages  none: it listens nowhere
  WebTransport(const Options& options, std::optional<internal::Pages> pages,
               std::vector<std::string> hosts, ClientSide client)
      : options_(options),
        pages_(std::move(pages)),
        hosts_(std::move(hosts)),
        client_(std::move(client)) {}

  std::string scheme() const override { return encrypted() ? "wss" : "ws"; }
  bool safe(const Address& address) const override {
    if (encrypted()) return true;
    const auto host = platform::look_up(address.host);
    return host && platform::is_loopback(host.value());
  }
  base::Result<Address> look_up(const Address& address) override {
    const auto host = platform::look_up(address.host);
    if (!host) return base::Error{host.error()};
    Address numeric{address.scheme, host.value(), address.port};
    if (numeric.host != address.host) numeric.name = address.host;
    return numeric;
  }
  base::Result<std::unique_ptr<ride::Listener>> listen(const Address& address) override {
    if (!pages_) {
      return base::Error{"'" + address.text() + "': there is no folder of pages to serve"};
    }
    if (encrypted() && options_.certificate.empty()) {
      return base::Error{"'" + address.text() + "': there is no certificate to encrypt with"};
    }
    if (!safe(address)) {
      return base::Error{"'" + address.text() +
                         "': without encryption pages are served to this machine only; listen at "
                         "127.0.0.1 or ::1, or at wss:// with a certificate"};
    }
    auto server = internal::Server::listen(address, options_, *pages_, hosts_);
    if (!server) return base::Error{server.error()};
    const std::lock_guard lock(mutex_);
    urls_.push_back(server.value()->url());
    return std::unique_ptr<ride::Listener>(std::move(server).value());
  }
  base::Result<std::unique_ptr<ride::Connection>> connect(const Address& address) override {
    if (client_.under == nullptr) {
      return base::Error{"'" + address.text() +
                         "': no authority is given that signs the certificate there"};
    }
    auto connection = client_.under->connect(address);
    if (!connection) return connection;
    const std::string& name = address.name.empty() ? address.host : address.name;
    internal::Door door = internal::door_of(name, address.port, encrypted());
    door.token = client_.tokens.of(door.origin);
    return std::unique_ptr<ride::Connection>(std::make_unique<internal::ClientConnection>(
        std::move(connection).value(), std::move(door)));
  }
  std::vector<std::string> pages() const override {
    const std::lock_guard lock(mutex_);
    return urls_;
  }

 private:
  bool encrypted() const { return is_encrypted(options_); }

  const Options options_;
  const std::optional<internal::Pages> pages_;
  const std::vector<std::string> hosts_;  ///< those of the certificate
  const ClientSide client_;
  mutable std::mutex mutex_;
  std::vector<std::string> urls_;
};

ClientSide client_side(const Options& options, base::Diagnostics& diagnostics) {
  ClientSide client{nullptr, internal::Tokens::load(options.tokens, diagnostics)};
  if (!is_encrypted(options)) {
    client.under = ride::make_tcp_transport();
  } else if (!options.authority.empty()) {
    client.under = tls::make_client_transport({options.certificate, options.key, options.authority},
                                              diagnostics);
  }
  return client;
}

}  // namespace

std::shared_ptr<Transport> make_transport(const Options& options, base::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  std::optional<internal::Pages> served;
  std::vector<std::string> hosts;
  if (!options.pages.empty()) {
    auto pages = internal::Pages::in(options.pages);
    if (!pages) diagnostics.error({}, pages.error(), "name a folder with an index.html");
    if (pages) served.emplace(std::move(pages).value());
    if (!options.certificate.empty()) {
      hosts = tls::check_server_files({options.certificate, options.key}, diagnostics);
    }
  }
  if (diagnostics.error_count() != before) return nullptr;
  ClientSide client = client_side(options, diagnostics);
  if (diagnostics.error_count() != before) return nullptr;
  return std::make_shared<WebTransport>(options, std::move(served), std::move(hosts),
                                        std::move(client));
}

}  // namespace armature::websocket
