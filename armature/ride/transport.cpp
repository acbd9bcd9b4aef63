// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/transport.hpp"

#include <utility>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/ride/socket_connection.hpp"

namespace armature::ride {
namespace {

using platform::StreamListener;
using platform::StreamSocket;

class SocketListener final : public Listener {
 public:
  SocketListener(std::unique_ptr<StreamListener> listener, Address address)
      : listener_(std::move(listener)), address_(std::move(address)) {}

  int handle() const override { return listener_->handle(); }
  std::unique_ptr<Connection> accept() override {
    auto socket = listener_->accept();
    if (!socket) return nullptr;
    std::string identity = socket->peer_account();
    return make_connection(std::move(socket), std::move(identity));
  }
  const Address& address() const override { return address_; }

 private:
  std::unique_ptr<StreamListener> listener_;
  Address address_;
};

base::Result<std::unique_ptr<Listener>> wrap(base::Result<std::unique_ptr<StreamListener>> made,
                                             Address address) {
  if (!made) return base::Error{made.error()};
  address.port = made.value()->port();
  return std::unique_ptr<Listener>(
      std::make_unique<SocketListener>(std::move(made).value(), std::move(address)));
}

base::Result<std::unique_ptr<Connection>> wrap(base::Result<std::unique_ptr<StreamSocket>> made) {
  if (!made) return base::Error{made.error()};
  return make_connection(std::move(made).value());
}

class TcpTransport final : public Transport {
 public:
  std::string scheme() const override { return "tcp"; }
  bool safe(const Address& address) const override {
    const auto host = platform::look_up(address.host);
    return host && platform::is_loopback(host.value());
  }
  base::Result<Address> look_up(const Address& address) override {
    const auto host = platform::look_up(address.host);
    if (!host) return base::Error{host.error()};
    return Address{address.scheme, host.value(), address.port};
  }
  base::Result<std::unique_ptr<Listener>> listen(const Address& address) override {
    return wrap(StreamListener::listen_tcp(address.host, address.port), address);
  }
  base::Result<std::unique_ptr<Connection>> connect(const Address& address) override {
    return wrap(StreamSocket::connect_tcp(address.host, address.port));
  }
};

class UnixTransport final : public Transport {
 public:
  explicit UnixTransport(unsigned mode) : mode_(mode) {}
  std::string scheme() const override { return "unix"; }
  bool safe(const Address&) const override { return true; }
  base::Result<std::unique_ptr<Listener>> listen(const Address& address) override {
    return wrap(StreamListener::listen_file(address.host, mode_), address);
  }
  base::Result<std::unique_ptr<Connection>> connect(const Address& address) override {
    return wrap(StreamSocket::connect_file(address.host));
  }

 private:
  const unsigned mode_;
};

}  // namespace

std::unique_ptr<Transport> make_tcp_transport() { return std::make_unique<TcpTransport>(); }
std::unique_ptr<Transport> make_unix_transport(unsigned mode) {
  return std::make_unique<UnixTransport>(mode);
}

}  // namespace armature::ride
