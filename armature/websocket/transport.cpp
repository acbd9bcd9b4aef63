// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/transport.hpp"

#include <mutex>
#include <utility>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/tls/server_files.hpp"
#include "armature/websocket/internal/pages.hpp"
#include "armature/websocket/internal/server.hpp"

namespace armature::websocket {
namespace {

using ride::Address;

class WebTransport final : public Transport {
 public:
  WebTransport(const Options& options, internal::Pages pages, std::vector<std::string> hosts)
      : options_(options), pages_(std::move(pages)), hosts_(std::move(hosts)) {}

  std::string scheme() const override { return encrypted() ? "wss" : "ws"; }
  bool safe(const Address& address) const override {
    if (encrypted()) return true;
    const auto host = platform::look_up(address.host);
    return host && platform::is_loopback(host.value());
  }
  base::Result<Address> look_up(const Address& address) override {
    const auto host = platform::look_up(address.host);
    if (!host) return base::Error{host.error()};
    return Address{address.scheme, host.value(), address.port};
  }
  base::Result<std::unique_ptr<ride::Listener>> listen(const Address& address) override {
    if (!safe(address)) {
      return base::Error{"'" + address.text() +
                         "': without encryption pages are served to this machine only; listen at "
                         "127.0.0.1 or ::1, or at wss:// with a certificate"};
    }
    auto server = internal::Server::listen(address, options_, pages_, hosts_);
    if (!server) return base::Error{server.error()};
    const std::lock_guard lock(mutex_);
    urls_.push_back(server.value()->url());
    return std::unique_ptr<ride::Listener>(std::move(server).value());
  }
  base::Result<std::unique_ptr<ride::Connection>> connect(const Address& address) override {
    return base::Error{"'" + address.text() + "': only pages connect over " + scheme() +
                       "; programs use tcp, unix or tls"};
  }
  std::vector<std::string> pages() const override {
    const std::lock_guard lock(mutex_);
    return urls_;
  }

 private:
  bool encrypted() const { return !options_.certificate.empty(); }

  const Options options_;
  const internal::Pages pages_;
  const std::vector<std::string> hosts_;  ///< those of the certificate
  mutable std::mutex mutex_;
  std::vector<std::string> urls_;
};

}  // namespace

std::shared_ptr<Transport> make_transport(const Options& options, base::Diagnostics& diagnostics) {
  const auto pages = internal::Pages::in(options.pages);
  if (!pages) diagnostics.error({}, pages.error(), "name a folder with an index.html");
  std::vector<std::string> hosts;
  if (!options.certificate.empty()) {
    hosts = tls::check_server_files({options.certificate, options.key}, diagnostics);
    if (hosts.empty()) return nullptr;
  }
  if (!pages) return nullptr;
  return std::make_shared<WebTransport>(options, pages.value(), std::move(hosts));
}

}  // namespace armature::websocket
