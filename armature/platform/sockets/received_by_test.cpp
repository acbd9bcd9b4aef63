// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/received_by.hpp"

#include <array>
#include <string>

#include <gtest/gtest.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace armature::platform {
namespace {

/// A socket of UDP that receives at all addresses, at a port that was free.
class Receiver {
 public:
  Receiver() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    socklen_t size = sizeof address;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port = ntohs(address.sin_port);
  }
  ~Receiver() { close(socket_); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  /// Empty: any.
  std::string interface() const {
    std::array<char, IFNAMSIZ> name{};
    socklen_t size = name.size();
    getsockopt(socket_, SOL_SOCKET, SO_BINDTODEVICE, name.data(), &size);
    return name.data();
  }

  int port = 0;

 private:
  int socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

TEST(ReceivedBy, OnlySocketsAtThePortsAreGivenWhatComesByTheInterface) {
  const Receiver inside;
  const Receiver outside;
  const auto kept = receive_only_by("lo", {inside.port, inside.port});
  ASSERT_TRUE(kept) << kept.error();
  EXPECT_EQ(kept.value(), 1);
  EXPECT_EQ(inside.interface(), "lo");
  EXPECT_EQ(outside.interface(), "");
  EXPECT_FALSE(receive_only_by("none-such", {outside.port, outside.port}));
}

}  // namespace
}  // namespace armature::platform
