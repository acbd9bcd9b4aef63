// SPDX-License-Identifier: Apache-2.0
// What comes from other machines to a node that is to stay on this one. In a network namespace of
// its own, with an interface by which this test sends as another machine does; skipped where the
// system does not allow that.
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bridges/ros2/participant.hpp"

namespace armature::ros2 {
namespace {

constexpr int kDomain = 61;
constexpr int kDiscoveryPort = 7400 + 250 * kDomain + 10;  // of the first participant
constexpr const char* kHere = "10.77.0.1";
constexpr const char* kOther = "10.77.0.2";

enum Verdict { kStaysHere = 0, kIsReached = 1, kNotAllowed = 2, kBroken = 3 };

ifreq request_for(const char* interface) {
  ifreq request{};
  std::strncpy(request.ifr_name, interface, IFNAMSIZ - 1);
  return request;
}

bool raise_up(int socket, const char* interface) {
  ifreq request = request_for(interface);
  request.ifr_flags = IFF_UP | IFF_RUNNING;
  return ioctl(socket, SIOCSIFFLAGS, &request) == 0;
}

bool give_address(int socket, const char* interface) {
  ifreq request = request_for(interface);
  auto& address = reinterpret_cast<sockaddr_in&>(request.ifr_addr);
  address.sin_family = AF_INET;
  inet_pton(AF_INET, kHere, &address.sin_addr);
  if (ioctl(socket, SIOCSIFADDR, &request) != 0) return false;
  inet_pton(AF_INET, "255.255.255.0", &address.sin_addr);
  return ioctl(socket, SIOCSIFNETMASK, &request) == 0;
}

/// What is written to it comes by the interface `net0`; below 0 if that is not allowed.
int open_interface() {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return -1;
  const int tunnel = open("/dev/net/tun", O_RDWR | O_CLOEXEC);
  ifreq request = request_for("net0");
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  if (tunnel < 0 || ioctl(tunnel, TUNSETIFF, &request) != 0) return -1;
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool up =
      raise_up(socket, "lo") && give_address(socket, "net0") && raise_up(socket, "net0");
  close(socket);
  return up ? tunnel : -1;
}

std::uint16_t checksum_of(const ip& header) {
  std::array<std::uint16_t, sizeof header / 2> words{};
  std::memcpy(words.data(), &header, sizeof header);
  std::uint32_t sum = 0;
  for (const std::uint16_t word : words) sum += word;
  while (sum > 0xffff) sum = (sum & 0xffff) + (sum >> 16);
  return static_cast<std::uint16_t>(~sum);
}

/// A datagram of another machine, to a port of this one.
void send_from_outside(int tunnel, int port) {
  struct {
    ip outer;
    udphdr inner;
    char text[4];
  } packet{};
  packet.outer.ip_v = 4;
  packet.outer.ip_hl = sizeof packet.outer / 4;
  packet.outer.ip_len = htons(sizeof packet);
  packet.outer.ip_ttl = 64;
  packet.outer.ip_p = IPPROTO_UDP;
  inet_pton(AF_INET, kOther, &packet.outer.ip_src);
  inet_pton(AF_INET, kHere, &packet.outer.ip_dst);
  packet.outer.ip_sum = checksum_of(packet.outer);
  packet.inner.uh_sport = htons(9);
  packet.inner.uh_dport = htons(static_cast<std::uint16_t>(port));
  packet.inner.uh_ulen = htons(sizeof packet.inner + sizeof packet.text);
  std::memcpy(packet.text, "RTPS", sizeof packet.text);
  static_cast<void>(!write(tunnel, &packet, sizeof packet));
}

/// Datagrams that found no socket in this namespace.
long unreached() {
  std::ifstream file("/proc/thread-self/net/snmp");
  std::string line;
  while (std::getline(file, line)) {
    if (!line.starts_with("Udp: ") || line.starts_with("Udp: In")) continue;
    std::istringstream words(line.substr(5));
    long received = 0;
    long without_port = -1;
    words >> received >> without_port;
    return without_port;
  }
  return -1;
}

Verdict reach_from_outside(const char* interface) {
  const int tunnel = open_interface();
  if (tunnel < 0) return kNotAllowed;
  const auto node = Participant::open({.domain = kDomain, .interface = interface});
  if (!node) return kBroken;
  const long before = unreached();
  send_from_outside(tunnel, kDiscoveryPort);  // it is taken or refused within the write
  return unreached() == before ? kIsReached : kStaysHere;
}

/// In a process of its own, whose namespace ends with it.
Verdict verdict_on(const char* interface) {
  const pid_t child = fork();
  if (child == 0) _exit(reach_from_outside(interface));
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? static_cast<Verdict>(WEXITSTATUS(status)) : kBroken;
}

TEST(Loopback, NothingFromOtherMachinesReachesANodeThatIsToStayOnThisOne) {
  const Verdict open = verdict_on("net0");
  if (open == kNotAllowed) GTEST_SKIP() << "network namespaces or /dev/net/tun are not allowed";
  ASSERT_EQ(open, kIsReached) << "the test does not send as another machine does";
  for (const char* interface : {"lo", "127.0.0.1"}) EXPECT_EQ(verdict_on(interface), kStaysHere);
}

}  // namespace
}  // namespace armature::ros2
