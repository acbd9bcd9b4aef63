// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/packet_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"
#include "armature/platform/internal/descriptor.hpp"
#include "armature/platform/internal/edge_events.hpp"
#include "armature/platform/internal/socket_file.hpp"

namespace armature::platform {
namespace {

using internal::address_of;
using internal::Descriptor;
using internal::no_address;

base::Error failed(const std::string& path, const std::string& what, int error) {
  return base::Error{"'" + path + "': " + what + ": " + std::generic_category().message(error)};
}

int make_socket() { return ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0); }

/// 0 or what went wrong. Never waits: a server whose queue is full refuses.
int connect_to(int socket, const std::string& path) {
  const auto address = address_of(path);
  if (!address) return ENAMETOOLONG;
  const auto* const raw = reinterpret_cast<const sockaddr*>(&*address);
  return ::connect(socket, raw, sizeof *address) == 0 ? 0 : errno;
}

PacketSent send_to(int socket, std::span<const std::byte> packet) {
  const ssize_t sent = ::send(socket, packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent == static_cast<ssize_t>(packet.size())) return PacketSent::kYes;
  const bool full = errno == EAGAIN || errno == ENOBUFS || errno == EINTR || errno == ENOMEM;
  return full ? PacketSent::kFull : PacketSent::kGone;
}

/// An empty packet cannot be told from the end, so whoever sends one has gone.
PacketReceived receive_from(int socket, std::span<std::byte> room, std::size_t& size) {
  const ssize_t received = ::recv(socket, room.data(), room.size(), MSG_DONTWAIT | MSG_TRUNC);
  if (received > 0) {
    size = static_cast<std::size_t>(received);
    return PacketReceived::kYes;
  }
  const bool nothing = received < 0 && (errno == EAGAIN || errno == EINTR);
  return nothing ? PacketReceived::kNothing : PacketReceived::kGone;
}

/// Waits for any of them; none is negative.
void poll_until(pollfd* polled, std::size_t count, base::Time deadline) {
  constexpr base::Duration kMost = std::chrono::hours(1);
  const base::Duration left = std::clamp(deadline - monotonic_now(), base::Duration::zero(), kMost);
  timespec timeout{};
  timeout.tv_sec = static_cast<time_t>(left.count() / 1'000'000'000);
  timeout.tv_nsec = static_cast<long>(left.count() % 1'000'000'000);
  ::ppoll(polled, static_cast<nfds_t>(count), &timeout, nullptr);
}

}  // namespace

base::Result<std::unique_ptr<PacketSocket>> PacketSocket::connect(const std::string& path) {
  if (!address_of(path)) return no_address(path);
  Descriptor socket(make_socket());
  if (const int error = connect_to(socket.get(), path); error != 0) {
    return failed(path, "no process serves there", error);
  }
  Descriptor events(::epoll_create1(EPOLL_CLOEXEC));
  Descriptor interruption(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!internal::add_event(events.get(), socket.get(), EPOLLIN | EPOLLET) ||
      !internal::add_event(events.get(), interruption.get(), EPOLLIN)) {
    return failed(path, "cannot be watched for data", errno);
  }
  return std::unique_ptr<PacketSocket>(
      new PacketSocket(path, socket.release(), events.release(), interruption.release()));
}

PacketSocket::~PacketSocket() {
  ::close(socket_);
  ::close(events_);
  ::close(interruption_);
}

PacketSent PacketSocket::send(std::span<const std::byte> packet) {
  return send_to(socket_, packet);
}

PacketReceived PacketSocket::receive(std::span<std::byte> room, std::size_t& size) {
  return receive_from(socket_, room, size);
}

/// The descriptor keeps its number, so the threads that receive and wait need not be told.
bool PacketSocket::try_reconnect() {
  const Descriptor fresh(make_socket());
  if (fresh.get() < 0 || connect_to(fresh.get(), path_) != 0) return false;
  return ::dup3(fresh.get(), socket_, O_CLOEXEC) == socket_ &&
         internal::add_event(events_, socket_, EPOLLIN | EPOLLET);
}

bool PacketSocket::wait() { return internal::wait_for_events(events_, interruption_); }

void PacketSocket::interrupt() { internal::interrupt_events(interruption_); }

bool PacketSocket::pause(base::Duration time) {
  const base::Time end = monotonic_now() + time;
  pollfd polled{.fd = interruption_, .events = POLLIN, .revents = 0};
  while (polled.revents == 0 && monotonic_now() < end) poll_until(&polled, 1, end);
  return polled.revents == 0;
}

bool PacketSocket::other_end_is_gone() const {
  pollfd polled{.fd = socket_, .events = POLLRDHUP, .revents = 0};
  return ::poll(&polled, 1, 0) == 1;
}

bool PacketSocket::wait_for_packet(base::Time deadline) {
  pollfd polled{.fd = socket_, .events = POLLIN, .revents = 0};
  while (polled.revents == 0 && monotonic_now() < deadline) poll_until(&polled, 1, deadline);
  return polled.revents != 0;
}

/// Of all places, and of the listener behind them.
struct PacketServer::Polled {
  std::vector<pollfd> all;
};

base::Result<std::unique_ptr<PacketServer>> PacketServer::listen(const std::string& path,
                                                                 std::size_t places) {
  constexpr int kMostThatWait = 16;
  const auto address = address_of(path);
  if (!address) return no_address(path);
  if (auto room = internal::make_room(path, SOCK_SEQPACKET); !room)
    return base::Error{room.error()};
  Descriptor listener(make_socket());
  if (::bind(listener.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
    return failed(path, "cannot be made", errno);
  }
  if (::listen(listener.get(), kMostThatWait) != 0) return failed(path, "cannot serve", errno);
  return std::unique_ptr<PacketServer>(new PacketServer(path, listener.release(), places));
}

PacketServer::PacketServer(std::string path, int listener, std::size_t places)
    : path_(std::move(path)),
      listener_(listener),
      clients_(places, -1),
      wants_to_send_(places, false),
      polled_(std::make_unique<Polled>()) {
  polled_->all.resize(places + 1);
}

PacketServer::~PacketServer() {
  for (std::size_t place = 0; place < places(); ++place) drop(place);
  ::unlink(path_.c_str());
  ::close(listener_);
}

std::size_t PacketServer::accept() {
  constexpr base::Duration kPause = std::chrono::milliseconds(100);
  if (monotonic_now() < accept_from_) return places();
  const int client = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (client < 0) {
    // Without descriptors or memory it would come back at once, again and again.
    if (errno != EAGAIN && errno != EINTR) accept_from_ = monotonic_now() + kPause;
    return places();
  }
  const auto empty = std::ranges::find(clients_, -1);
  if (empty == clients_.end()) {
    ::close(client);
    return places();
  }
  *empty = client;
  return static_cast<std::size_t>(empty - clients_.begin());
}

PacketSent PacketServer::send(std::size_t place, std::span<const std::byte> packet) {
  return send_to(clients_[place], packet);
}

PacketReceived PacketServer::receive(std::size_t place, std::span<std::byte> room,
                                     std::size_t& size) {
  return receive_from(clients_[place], room, size);
}

void PacketServer::drop(std::size_t place) {
  if (!taken(place)) return;
  ::close(std::exchange(clients_[place], -1));
  wants_to_send_[place] = false;
}

void PacketServer::wait_until(base::Time deadline) {
  for (std::size_t place = 0; place < places(); ++place) {
    const int events = wants_to_send_[place] ? POLLIN | POLLOUT : POLLIN;
    polled_->all[place] = {clients_[place], static_cast<short>(events), 0};
  }
  const bool accepts = monotonic_now() >= accept_from_;
  polled_->all.back() = {accepts ? listener_ : -1, POLLIN, 0};
  poll_until(polled_->all.data(), polled_->all.size(), deadline);
}

}  // namespace armature::platform
