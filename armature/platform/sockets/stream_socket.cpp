// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/stream_socket.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <system_error>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include "armature/platform/internal/descriptor.hpp"
#include "armature/platform/internal/direct_calls.hpp"
#include "armature/platform/internal/socket_file.hpp"

namespace armature::platform {
namespace {

using internal::Descriptor;

base::Error unable(const std::string& what, const std::string& problem, int error) {
  return base::Error{"'" + what + "': " + problem + ": " + std::generic_category().message(error)};
}

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
  const sockaddr* raw() const { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* raw() { return reinterpret_cast<sockaddr*>(&storage); }
};

std::optional<SocketAddress> numeric_address(const std::string& host, std::uint16_t port) {
  SocketAddress address;
  auto* const four = reinterpret_cast<sockaddr_in*>(&address.storage);
  auto* const six = reinterpret_cast<sockaddr_in6*>(&address.storage);
  if (::inet_pton(AF_INET, host.c_str(), &four->sin_addr) == 1) {
    four->sin_family = AF_INET;
    four->sin_port = htons(port);
    address.size = sizeof *four;
    return address;
  }
  if (::inet_pton(AF_INET6, host.c_str(), &six->sin6_addr) == 1) {
    six->sin6_family = AF_INET6;
    six->sin6_port = htons(port);
    address.size = sizeof *six;
    return address;
  }
  return std::nullopt;
}

base::Error not_numeric(const std::string& host) {
  return base::Error{"'" + host + "': expected a numeric address such as 127.0.0.1 or ::1"};
}

/// `127.0.0.1:4242`; of a socket file its path is all there is.
std::string host_of(const SocketAddress& address) {
  char host[NI_MAXHOST] = "";
  ::getnameinfo(address.raw(), address.size, host, sizeof host, nullptr, 0, NI_NUMERICHOST);
  return host;
}

std::string text_of(const SocketAddress& address) {
  char host[NI_MAXHOST] = "";
  char port[NI_MAXSERV] = "";
  if (::getnameinfo(address.raw(), address.size, host, sizeof host, port, sizeof port,
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "unknown";
  }
  return std::string(host) + ":" + port;
}

void set_option(int socket, int level, int option) {
  const int on = 1;
  ::setsockopt(socket, level, option, &on, sizeof on);
}

bool is_loopback(const SocketAddress& address) {
  const void* const raw = &address.storage;
  if (address.storage.ss_family == AF_INET) {
    return ntohl(static_cast<const sockaddr_in*>(raw)->sin_addr.s_addr) >> 24 == 127;
  }
  return IN6_IS_ADDR_LOOPBACK(&static_cast<const sockaddr_in6*>(raw)->sin6_addr);
}

/// Small messages are not held back. Within the machine nothing is congested, and the control that
/// computes least saves two percent of a round trip; where it is not to be had, nothing is lost.
void tune(int socket, const SocketAddress& address) {
  constexpr char kLeast[] = "reno";
  set_option(socket, IPPROTO_TCP, TCP_NODELAY);
  if (is_loopback(address)) {
    ::setsockopt(socket, IPPROTO_TCP, TCP_CONGESTION, kLeast, sizeof kLeast - 1);
  }
}

int port_of(int socket) {
  SocketAddress address;
  address.size = sizeof address.storage;
  if (::getsockname(socket, address.raw(), &address.size) != 0) return 0;
  const void* const raw = &address.storage;
  return ntohs(address.storage.ss_family == AF_INET6
                   ? static_cast<const sockaddr_in6*>(raw)->sin6_port
                   : static_cast<const sockaddr_in*>(raw)->sin_port);
}

/// Within the machine the system may choose, for who connects to a port where nobody listens, that
/// very port: then it is connected to itself, and whoever is to listen there finds the port taken.
bool is_connected_to_itself(int socket) {
  SocketAddress own;
  SocketAddress other;
  own.size = other.size = sizeof own.storage;
  return ::getsockname(socket, own.raw(), &own.size) == 0 && own.storage.ss_family != AF_UNIX &&
         ::getpeername(socket, other.raw(), &other.size) == 0 && own.size == other.size &&
         std::memcmp(&own.storage, &other.storage, own.size) == 0;
}

constexpr int kMostThatWait = 64;

std::string name_of_account(uid_t number) {
  passwd account{};
  passwd* found = nullptr;
  std::array<char, 4096> texts{};
  if (::getpwuid_r(number, &account, texts.data(), texts.size(), &found) == 0 && found) {
    return account.pw_name;
  }
  return std::to_string(number);
}

}  // namespace

base::Result<std::unique_ptr<StreamSocket>> StreamSocket::connect_tcp(const std::string& host,
                                                                      std::uint16_t port) {
  const auto address = numeric_address(host, port);
  if (!address) return not_numeric(host);
  const std::string text = text_of(*address);
  Descriptor socket(
      ::socket(address->storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) return unable(text, "no socket", errno);
  tune(socket.get(), *address);
  if (::connect(socket.get(), address->raw(), address->size) != 0 && errno != EINPROGRESS) {
    return unable(text, "cannot be connected to", errno);
  }
  return std::unique_ptr<StreamSocket>(new StreamSocket(socket.release(), text, false));
}

base::Result<std::unique_ptr<StreamSocket>> StreamSocket::connect_file(const std::string& path) {
  const auto address = internal::address_of(path);
  if (!address) return internal::no_address(path);
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) return unable(path, "no socket", errno);
  const auto* const raw = reinterpret_cast<const sockaddr*>(&*address);
  if (::connect(socket.get(), raw, sizeof *address) != 0) {
    return unable(path, "no process serves there", errno);
  }
  return std::unique_ptr<StreamSocket>(new StreamSocket(socket.release(), path, false));
}

base::Result<std::pair<std::unique_ptr<StreamSocket>, std::unique_ptr<StreamSocket>>>
StreamSocket::make_pair(const std::string& other_end) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    return unable(other_end, "no socket", errno);
  }
  return std::pair(std::unique_ptr<StreamSocket>(new StreamSocket(ends[0], other_end, true)),
                   std::unique_ptr<StreamSocket>(new StreamSocket(ends[1], other_end, true)));
}

StreamSocket::~StreamSocket() { ::close(socket_); }

StreamStatus StreamSocket::finish_connect() {
  if (connected_) return StreamStatus::kDone;
  pollfd polled{.fd = socket_, .events = POLLOUT, .revents = 0};
  if (::poll(&polled, 1, 0) == 0) return StreamStatus::kLater;
  int error = 0;
  socklen_t size = sizeof error;
  if (::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
  if (error == 0 && is_connected_to_itself(socket_)) error = ECONNREFUSED;
  error_ = error;
  if (error != 0) return StreamStatus::kGone;
  begin_to_flow();
  return StreamStatus::kDone;
}

/// From now on it waits where it is asked to, and only there: other calls say so themselves.
void StreamSocket::begin_to_flow() {
  ::fcntl(socket_, F_SETFL, ::fcntl(socket_, F_GETFL) & ~O_NONBLOCK);
  connected_ = true;
}

StreamStatus StreamSocket::send(std::span<const std::byte> bytes, std::size_t& sent) {
  const ssize_t taken =
      internal::direct_send(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (taken >= 0) {
    sent = static_cast<std::size_t>(taken);
    return StreamStatus::kDone;
  }
  if (errno == EAGAIN || errno == EINTR || errno == ENOBUFS) return StreamStatus::kLater;
  error_ = errno;
  return StreamStatus::kGone;
}

StreamStatus StreamSocket::after_receiving(std::ptrdiff_t received, std::size_t& size) {
  if (received > 0) {
    size = static_cast<std::size_t>(received);
    return StreamStatus::kDone;
  }
  if (received < 0 && (errno == EAGAIN || errno == EINTR)) return StreamStatus::kLater;
  error_ = received < 0 ? errno : 0;
  return StreamStatus::kGone;
}

StreamStatus StreamSocket::receive(std::span<std::byte> room, std::size_t& size) {
  return after_receiving(internal::direct_recv(socket_, room.data(), room.size(), MSG_DONTWAIT),
                         size);
}

StreamStatus StreamSocket::wait_and_receive(std::span<std::byte> room, std::size_t& size,
                                            base::Duration limit) {
  if (limit != limit_) {
    constexpr auto kLeast = std::chrono::microseconds(1);  // 0 would be forever
    const auto us = std::max(std::chrono::ceil<std::chrono::microseconds>(limit), kLeast).count();
    timeval timeout{};
    timeout.tv_sec = static_cast<time_t>(us / 1'000'000);
    timeout.tv_usec = static_cast<suseconds_t>(us % 1'000'000);
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    limit_ = limit;
  }
  return after_receiving(internal::direct_recv(socket_, room.data(), room.size(), 0), size);
}

bool StreamSocket::set_priority(int level) {
  return ::setsockopt(socket_, SOL_SOCKET, SO_PRIORITY, &level, sizeof level) == 0;
}

StreamStatus StreamSocket::wait_until_readable(base::Duration limit) const {
  return wait_until(POLLIN, limit);
}

StreamStatus StreamSocket::wait_until_writable(base::Duration limit) const {
  return wait_until(POLLOUT, limit);
}

StreamStatus StreamSocket::wait_until(short events, base::Duration limit) const {
  const std::int64_t ns = std::max<std::int64_t>(limit.count(), 0);
  const timespec most{static_cast<time_t>(ns / 1'000'000'000),
                      static_cast<long>(ns % 1'000'000'000)};
  pollfd polled{.fd = socket_, .events = events, .revents = 0};
  return ::ppoll(&polled, 1, &most, nullptr) > 0 ? StreamStatus::kDone : StreamStatus::kLater;
}

void StreamSocket::shut_down() { ::shutdown(socket_, SHUT_RDWR); }

std::string StreamSocket::problem() const {
  const int error = error_;
  return error == 0 ? "the other side has ended it" : std::generic_category().message(error);
}

std::string StreamSocket::peer_account() const {
  ucred peer{};
  socklen_t size = sizeof peer;
  sockaddr_storage own{};
  socklen_t own_size = sizeof own;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &own_size) != 0 ||
      own.ss_family != AF_UNIX ||
      ::getsockopt(socket_, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) {
    return {};
  }
  return name_of_account(peer.uid);
}

std::string own_account() { return name_of_account(::geteuid()); }

base::Result<std::unique_ptr<StreamListener>> StreamListener::listen_tcp(const std::string& host,
                                                                         std::uint16_t port) {
  const auto address = numeric_address(host, port);
  if (!address) return not_numeric(host);
  const std::string text = text_of(*address);
  Descriptor socket(
      ::socket(address->storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) return unable(text, "no socket", errno);
  set_option(socket.get(), SOL_SOCKET, SO_REUSEADDR);
  if (::bind(socket.get(), address->raw(), address->size) != 0) {
    return unable(text, "cannot be listened at", errno);
  }
  if (::listen(socket.get(), kMostThatWait) != 0) return unable(text, "cannot serve", errno);
  const auto got = static_cast<std::uint16_t>(port_of(socket.get()));
  return std::unique_ptr<StreamListener>(new StreamListener(socket.release(), {}, got));
}

base::Result<std::unique_ptr<StreamListener>> StreamListener::listen_file(const std::string& path,
                                                                          unsigned mode) {
  if (auto room = internal::make_room(path, SOCK_STREAM); !room) return base::Error{room.error()};
  const auto address = internal::address_of(path);
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const auto* const raw = reinterpret_cast<const sockaddr*>(&*address);
  // Nobody else gets in before it has its permissions.
  ::fchmod(socket.get(), S_IRUSR | S_IWUSR);
  if (::bind(socket.get(), raw, sizeof *address) != 0) {
    return unable(path, "cannot be made", errno);
  }
  if (::chmod(path.c_str(), static_cast<mode_t>(mode)) != 0) {
    const int error = errno;
    ::unlink(path.c_str());
    return unable(path, "cannot get its permissions", error);
  }
  if (::listen(socket.get(), kMostThatWait) != 0) return unable(path, "cannot serve", errno);
  return std::unique_ptr<StreamListener>(new StreamListener(socket.release(), path, 0));
}

StreamListener::~StreamListener() {
  if (!path_.empty()) ::unlink(path_.c_str());
  ::close(socket_);
}

std::unique_ptr<StreamSocket> StreamListener::accept() {
  SocketAddress address;
  address.size = sizeof address.storage;
  const int socket = ::accept4(socket_, address.raw(), &address.size, SOCK_CLOEXEC);
  if (socket < 0) return nullptr;
  if (path_.empty()) tune(socket, address);
  const std::string text = path_.empty() ? text_of(address) : path_;
  return std::unique_ptr<StreamSocket>(new StreamSocket(socket, text, true));
}

int another_handle(int handle) { return ::fcntl(handle, F_DUPFD_CLOEXEC, 0); }

std::string shortest_address(const std::string& host) {
  const auto address = numeric_address(host, 0);
  return address ? host_of(*address) : host;
}

base::Result<std::string> look_up(const std::string& host) {
  if (numeric_address(host, 0)) return host;
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), nullptr, &wanted, &found); error != 0) {
    return base::Error{"'" + host + "': no such host: " + ::gai_strerror(error)};
  }
  char text[NI_MAXHOST] = "";
  ::getnameinfo(found->ai_addr, found->ai_addrlen, text, sizeof text, nullptr, 0, NI_NUMERICHOST);
  ::freeaddrinfo(found);
  return std::string(text);
}

bool is_loopback(const std::string& host) {
  const auto address = numeric_address(host, 0);
  return address && is_loopback(*address);
}

}  // namespace armature::platform
