// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/bare_socket.hpp"

#include <algorithm>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include "benchmarks/check.hpp"

namespace armature::benchmarks {
namespace {

constexpr std::int64_t kPiece = BareSocket::kRoom;

int new_socket() { return ::socket(AF_INET, SOCK_STREAM, 0); }

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

sockaddr* raw(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

}  // namespace

BareSocket::BareSocket(int socket) : socket_(socket) {
  check(socket >= 0, "socket");
  const int on = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

BareSocket::~BareSocket() { ::close(socket_); }

void BareSocket::send(std::size_t size) {
  check(::send(socket_, bytes_, size, MSG_NOSIGNAL) == static_cast<ssize_t>(size), "send");
}

bool BareSocket::receive(std::size_t size) {
  for (std::size_t had = 0; had < size;) {
    const ssize_t got = ::recv(socket_, bytes_ + had, size - had, 0);
    if (got <= 0) return false;
    had += static_cast<std::size_t>(got);
  }
  return true;
}

BareListener::BareListener() : socket_(new_socket()) {
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  check(::bind(socket_.handle(), raw(address), size) == 0, "bind");
  check(::listen(socket_.handle(), SOMAXCONN) == 0, "listen");
  check(::getsockname(socket_.handle(), raw(address), &size) == 0, "getsockname");
  port_ = ntohs(address.sin_port);
}

std::unique_ptr<BareSocket> BareListener::accept() {
  return std::make_unique<BareSocket>(::accept(socket_.handle(), nullptr, nullptr));
}

std::unique_ptr<BareSocket> bare_connection(std::uint16_t port) {
  auto socket = std::make_unique<BareSocket>(new_socket());
  sockaddr_in address = loopback(port);
  check(::connect(socket->handle(), raw(address), sizeof address) == 0, "connect");
  return socket;
}

void bare_answer(BareSocket& server, std::size_t request, std::size_t reply) {
  while (server.receive(request)) server.send(reply);
}

void bare_ask(BareSocket& client, std::int64_t count, std::size_t request, std::size_t reply) {
  for (; count > 0; --count) {
    client.send(request);
    if (!client.receive(reply)) throw std::runtime_error("the bare server has gone");
  }
}

void bare_swallow(BareSocket& server) {
  while (server.receive(sizeof(std::int64_t))) {
    for (std::int64_t left = server.value(); left > 0; left -= kPiece) {
      if (!server.receive(static_cast<std::size_t>(std::min(left, kPiece)))) return;
    }
    server.send(1);
  }
}

void bare_pour(BareSocket& client, std::int64_t bytes) {
  client.set_value(bytes);
  client.send(sizeof bytes);
  for (std::int64_t left = bytes; left > 0; left -= kPiece) {
    client.send(static_cast<std::size_t>(std::min(left, kPiece)));
  }
  if (!client.receive(1)) throw std::runtime_error("the bare server has gone");
}

}  // namespace armature::benchmarks
