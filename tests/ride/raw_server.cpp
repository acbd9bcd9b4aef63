// SPDX-License-Identifier: Apache-2.0
// What a server costs that is nothing but a socket: the measure of minimal_server.
#include <cstdio>
#include <thread>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

int main() {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const raw = reinterpret_cast<sockaddr*>(&address);
  if (::bind(listener, raw, size) != 0 || ::listen(listener, 1) != 0) return 1;
  if (::getsockname(listener, raw, &size) != 0) return 1;
  std::thread server([listener] {
    const int client = ::accept(listener, nullptr, nullptr);
    const int on = 1;
    ::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    char message[64];
    while (::recv(client, message, sizeof message, 0) > 0) {
      if (::send(client, message, 20, MSG_NOSIGNAL) != 20) return;
    }
  });
  server.detach();
  std::printf("tcp://127.0.0.1:%d\n", ntohs(address.sin_port));
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
}
