// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/transport.hpp"

#include <utility>

#include "armature/platform/sockets/stream_socket.hpp"

namespace armature::ride {
namespace {

using platform::StreamListener;
using platform::StreamSocket;
using platform::StreamStatus;

Progress progress_of(StreamStatus status, Progress later) {
  if (status == StreamStatus::kDone) return Progress::kDone;
  return status == StreamStatus::kLater ? later : Progress::kGone;
}

class SocketConnection final : public Connection {
 public:
  explicit SocketConnection(std::unique_ptr<StreamSocket> socket, std::string identity = {})
      : socket_(std::move(socket)), identity_(std::move(identity)) {}

  int handle() const override { return socket_->handle(); }
  Progress establish() override {
    return progress_of(socket_->finish_connect(), Progress::kWantWrite);
  }
  Progress send(std::span<const std::byte> bytes, std::size_t& sent) override {
    return progress_of(socket_->send(bytes, sent), Progress::kWantWrite);
  }
  Progress receive(std::span<std::byte> room, std::size_t& size) override {
    return progress_of(socket_->receive(room, size), Progress::kWantRead);
  }
  bool takes_all() const override { return true; }
  Progress wait_and_receive(std::span<std::byte> room, std::size_t& size,
                            base::Duration limit) override {
    return progress_of(socket_->wait_and_receive(room, size, limit), Progress::kWantRead);
  }
  void set_level(int level) override { static_cast<void>(socket_->set_priority(level)); }
  void shut_down() override { socket_->shut_down(); }
  std::string other_end() const override { return socket_->other_end(); }
  std::string identity() const override { return identity_; }
  std::string problem() const override { return socket_->problem(); }
  bool may_still_receive() const override { return socket_->ended_in_order(); }

 private:
  std::unique_ptr<StreamSocket> socket_;
  const std::string identity_;
};

class SocketListener final : public Listener {
 public:
  SocketListener(std::unique_ptr<StreamListener> listener, Address address)
      : listener_(std::move(listener)), address_(std::move(address)) {}

  int handle() const override { return listener_->handle(); }
  std::unique_ptr<Connection> accept() override {
    auto socket = listener_->accept();
    if (!socket) return nullptr;
    std::string identity = socket->peer_account();
    return std::make_unique<SocketConnection>(std::move(socket), std::move(identity));
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
  return std::unique_ptr<Connection>(std::make_unique<SocketConnection>(std::move(made).value()));
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
