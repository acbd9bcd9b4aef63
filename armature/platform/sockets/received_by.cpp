// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/received_by.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include <netinet/in.h>
#include <sys/socket.h>

namespace armature::platform {
namespace {

bool is_udp(int socket) {
  int protocol = 0;
  socklen_t size = sizeof protocol;
  return getsockopt(socket, SOL_SOCKET, SO_PROTOCOL, &protocol, &size) == 0 &&
         protocol == IPPROTO_UDP;
}

/// That a socket of UDP receives at; nothing if it is none.
std::optional<int> udp_port_of(int socket) {
  if (!is_udp(socket)) return std::nullopt;
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
  in_port_t port = 0;
  if (address.ss_family == AF_INET) {
    port = reinterpret_cast<const sockaddr_in*>(&address)->sin_port;
  } else if (address.ss_family == AF_INET6) {
    port = reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port;
  }
  return ntohs(port);
}

}  // namespace

base::Result<int> receive_only_by(const std::string& interface, UdpPorts ports) {
  int count = 0;
  std::error_code unreadable;
  for (const auto& each : std::filesystem::directory_iterator("/proc/self/fd", unreadable)) {
    const std::string name = each.path().filename();
    int socket = -1;
    std::from_chars(name.data(), name.data() + name.size(), socket);
    const std::optional<int> port = udp_port_of(socket);
    if (!port || *port < ports.first || *port > ports.last) continue;
    if (setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, interface.c_str(),
                   static_cast<socklen_t>(interface.size())) != 0) {
      return base::Error{std::string(std::strerror(errno)) +
                         " (it needs Linux 5.7, or the capability CAP_NET_RAW)"};
    }
    ++count;
  }
  if (unreadable) return base::Error{"/proc/self/fd: " + unreadable.message()};
  return count;
}

}  // namespace armature::platform
