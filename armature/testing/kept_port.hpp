// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace armature::testing {

/// A port of this machine at which somebody of a test may listen again and again. Of one at which
/// nobody listens the system may give the number to any process that asks for a port, such as that
/// of the next test; of this one it does not, while who names the number can listen.
class KeptPort {
 public:
  KeptPort() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int on = 1;
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    auto* const raw = reinterpret_cast<sockaddr*>(&here);
    if (::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        ::bind(socket_, raw, sizeof here) != 0 || ::getsockname(socket_, raw, &size) != 0) {
      throw std::system_error(errno, std::generic_category(), "no port to keep");
    }
    number_ = ntohs(here.sin_port);
  }
  ~KeptPort() { ::close(socket_); }
  KeptPort(const KeptPort&) = delete;
  KeptPort& operator=(const KeptPort&) = delete;

  std::uint16_t number() const { return number_; }
  /// `tcp://127.0.0.1:40123`
  std::string address(const std::string& transport = "tcp") const {
    return transport + "://127.0.0.1:" + std::to_string(number_);
  }

 private:
  int socket_;
  std::uint16_t number_ = 0;
};

}  // namespace armature::testing
