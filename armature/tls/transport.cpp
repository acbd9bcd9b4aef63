// SPDX-License-Identifier: Apache-2.0
#include "armature/tls/transport.hpp"

#include <utility>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/tls/internal/connection.hpp"
#include "armature/tls/internal/credentials.hpp"

namespace armature::tls {
namespace {

using internal::ContextPointer;
using internal::TlsConnection;
using platform::StreamListener;
using platform::StreamSocket;
using ride::Address;

/// Sessions keep their context; the listener keeps one of its own, to outlive the transport.
ContextPointer shared(SSL_CTX* context) {
  SSL_CTX_up_ref(context);
  return ContextPointer(context);
}

class TlsListener final : public ride::Listener {
 public:
  TlsListener(std::unique_ptr<StreamListener> listener, Address address, ContextPointer context)
      : listener_(std::move(listener)),
        address_(std::move(address)),
        context_(std::move(context)) {}

  int handle() const override { return listener_->handle(); }
  std::unique_ptr<ride::Connection> accept() override {
    auto socket = listener_->accept();
    if (!socket) return nullptr;
    return TlsConnection::accepted(std::move(socket), *context_);
  }
  const Address& address() const override { return address_; }

 private:
  const std::unique_ptr<StreamListener> listener_;
  const Address address_;
  const ContextPointer context_;
};

class TlsTransport final : public ride::Transport {
 public:
  explicit TlsTransport(ContextPointer context) : context_(std::move(context)) {}

  std::string scheme() const override { return "tls"; }
  bool safe(const Address&) const override { return true; }

  base::Result<Address> look_up(const Address& address) override {
    auto host = platform::look_up(address.host);
    if (!host) return base::Error{host.error()};
    Address numeric{address.scheme, std::move(host).value(), address.port};
    if (numeric.host != address.host) numeric.name = address.host;
    return numeric;
  }

  base::Result<std::unique_ptr<ride::Listener>> listen(const Address& address) override {
    auto listener = StreamListener::listen_tcp(address.host, address.port);
    if (!listener) return base::Error{listener.error()};
    Address got = address;
    got.port = listener.value()->port();
    return std::unique_ptr<ride::Listener>(std::make_unique<TlsListener>(
        std::move(listener).value(), std::move(got), shared(context_.get())));
  }

  base::Result<std::unique_ptr<ride::Connection>> connect(const Address& address) override {
    auto socket = StreamSocket::connect_tcp(address.host, address.port);
    if (!socket) return base::Error{socket.error()};
    return std::unique_ptr<ride::Connection>(
        TlsConnection::dialled(std::move(socket).value(), *context_, address));
  }

 private:
  const ContextPointer context_;
};

}  // namespace

std::unique_ptr<ride::Transport> make_transport(const Options& options,
                                                base::Diagnostics& diagnostics) {
  ContextPointer context = internal::make_context(options, diagnostics);
  if (!context) return nullptr;
  return std::make_unique<TlsTransport>(std::move(context));
}

std::unique_ptr<ride::Transport> make_client_transport(const Options& options,
                                                       base::Diagnostics& diagnostics) {
  const bool proves_itself = !options.certificate.empty() || !options.key.empty();
  if (proves_itself) return make_transport(options, diagnostics);
  ContextPointer context = internal::make_context_without_own(options.authority, diagnostics);
  if (!context) return nullptr;
  return std::make_unique<TlsTransport>(std::move(context));
}

}  // namespace armature::tls
