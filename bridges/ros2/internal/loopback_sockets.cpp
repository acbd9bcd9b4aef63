// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/loopback_sockets.hpp"

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include <netinet/in.h>
#include <sys/socket.h>

namespace armature::ros2::internal {
namespace {

/// The ports of a domain, as the specification of RTPS counts them (section 9.6.1).
constexpr int kFirstPort = 7400;
constexpr int kPortsOfADomain = 250;

template <typename Number>
std::optional<Number> option_of(int socket, int name) {
  Number value{};
  socklen_t size = sizeof value;
  if (getsockopt(socket, SOL_SOCKET, name, &value, &size) != 0) return std::nullopt;
  return value;
}

/// That a socket of UDP receives at; nothing if it is none.
std::optional<int> udp_port_of(int socket) {
  if (option_of<int>(socket, SO_PROTOCOL) != IPPROTO_UDP) return std::nullopt;
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

bool is_of_domain(int socket, int domain) {
  const std::optional<int> port = udp_port_of(socket);
  return port && (*port - kFirstPort) / kPortsOfADomain == domain && *port >= kFirstPort;
}

}  // namespace

std::string keep_on_loopback(int domain) {
  constexpr char kLoopback[] = "lo";
  int kept = 0;
  std::error_code unreadable;
  for (const auto& each : std::filesystem::directory_iterator("/proc/self/fd", unreadable)) {
    const std::string name = each.path().filename();
    int socket = -1;
    std::from_chars(name.data(), name.data() + name.size(), socket);
    if (!is_of_domain(socket, domain)) continue;
    if (setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, kLoopback, sizeof kLoopback) != 0) {
      return std::string("DDS cannot be kept on this machine: ") + std::strerror(errno) +
             " (it needs Linux 5.7, or the capability CAP_NET_RAW)";
    }
    ++kept;
  }
  if (kept > 0) return {};
  return "DDS cannot be kept on this machine: its sockets are not found in /proc/self/fd" +
         (unreadable ? ": " + unreadable.message() : std::string());
}

}  // namespace armature::ros2::internal
