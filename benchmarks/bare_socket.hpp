// SPDX-License-Identifier: Apache-2.0
#pragma once

// What calls, commands and events between processes are measured against: sockets with nothing
// around them.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

namespace armature::benchmarks {

/// One end of a connection.
class BareSocket {
 public:
  /// Owns the descriptor.
  explicit BareSocket(int socket);
  BareSocket(const BareSocket&) = delete;
  BareSocket& operator=(const BareSocket&) = delete;
  ~BareSocket();

  static constexpr std::size_t kRoom = 64 * 1024;

  int handle() const { return socket_; }
  /// A number at the beginning of what is sent or was received.
  void set_value(std::int64_t value) { std::memcpy(bytes_, &value, sizeof value); }
  std::int64_t value() const {
    std::int64_t value = 0;
    std::memcpy(&value, bytes_, sizeof value);
    return value;
  }
  void send(std::size_t size);
  /// False when the other side is done.
  bool receive(std::size_t size);

 private:
  int socket_;
  char bytes_[kRoom] = {};
};

/// Where others connect to.
class BareListener {
 public:
  BareListener();
  std::uint16_t port() const { return port_; }
  std::unique_ptr<BareSocket> accept();

 private:
  BareSocket socket_;
  std::uint16_t port_ = 0;
};

std::unique_ptr<BareSocket> bare_connection(std::uint16_t port);

/// Answers so many bytes with so many, until the other side is done.
void bare_answer(BareSocket& server, std::size_t request, std::size_t reply);
/// Asks `count` times, each time with so many bytes for so many.
void bare_ask(BareSocket& client, std::int64_t count, std::size_t request, std::size_t reply);

/// Takes any number of bytes, and says so with one when it has them all; until the other side is
/// done.
void bare_swallow(BareSocket& server);
/// Sends so many bytes in large pieces, and waits until the other side has them all.
void bare_pour(BareSocket& client, std::int64_t bytes);

}  // namespace armature::benchmarks
