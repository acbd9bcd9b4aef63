// SPDX-License-Identifier: Apache-2.0
#pragma once

// The browser's end of a WebSocket, written from RFC 6455 alone, for tests.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/ride/transport.hpp"
#include "armature/websocket/internal/entry.hpp"

namespace armature::websocket::internal {

using namespace std::chrono_literals;

inline constexpr base::Duration kPatience = 20s;

/// A connection whose bytes a test writes and reads.
class RawVisitor {
 public:
  explicit RawVisitor(std::uint16_t port, const std::string& host = "127.0.0.1")
      : socket_(std::move(platform::StreamSocket::connect_tcp(host, port)).value()) {
    socket_->wait_until_writable(kPatience);
    socket_->finish_connect();
  }

  platform::StreamSocket& socket() { return *socket_; }

  bool send(std::string_view text) {
    std::span<const std::byte> left = std::as_bytes(std::span(text));
    while (!left.empty()) {
      std::size_t sent = 0;
      const auto status = socket_->send(left, sent);
      if (status == platform::StreamStatus::kGone) return false;
      if (status == platform::StreamStatus::kDone) left = left.subspan(sent);
      if (status == platform::StreamStatus::kLater &&
          socket_->wait_until_writable(kPatience) == platform::StreamStatus::kLater) {
        return false;
      }
    }
    return true;
  }

  /// What comes until the end, or until `limit` passes without anything.
  std::string read_to_end(base::Duration limit = kPatience) {
    std::string all;
    std::vector<std::byte> room(1 << 16);
    while (true) {
      std::size_t size = 0;
      const auto status = socket_->wait_and_receive(room, size, limit);
      ended_ = status == platform::StreamStatus::kGone;
      if (status != platform::StreamStatus::kDone) return all;
      all.append(reinterpret_cast<const char*>(room.data()), size);
    }
  }
  /// The other side has ended it.
  bool ended() const { return ended_; }

 private:
  std::unique_ptr<platform::StreamSocket> socket_;
  bool ended_ = false;
};

/// The request for a WebSocket, as a page of `host` sends it.
inline std::string upgrade(const std::string& host, const std::string& origin,
                           const std::string& cookie) {
  return "GET / HTTP/1.1\r\nHost: " + host + "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n" +
         (origin.empty() ? "" : "Origin: " + origin + "\r\n") +
         (cookie.empty() ? "" : "Cookie: " + cookie + "\r\n") +
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
}

/// A frame of a browser. @param size  what its header says; the payload may be shorter
inline std::string frame(std::uint8_t opcode, std::string_view payload, std::uint64_t size) {
  std::string text(1, static_cast<char>(0x80 | opcode));
  const int bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;
  text += static_cast<char>(0x80 | (bytes == 0 ? size : bytes == 2 ? 126U : 127U));
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(size >> (8 * i));
  constexpr char kMask[] = {'\x11', '\x22', '\x33', '\x44'};
  text.append(kMask, sizeof kMask);
  for (std::size_t i = 0; i < payload.size(); ++i)
    text += static_cast<char>(payload[i] ^ kMask[i % 4]);
  return text;
}
inline std::string frame(std::uint8_t opcode, std::string_view payload) {
  return frame(opcode, payload, payload.size());
}

/// The page's end as a connection of bytes, for what every transport has to do.
class TestPage final : public ride::Connection {
 public:
  TestPage(std::unique_ptr<platform::StreamSocket> socket, const std::string& host,
           const std::string& pass)
      : socket_(std::move(socket)) {
    socket_->wait_until_writable(kPatience);
    if (socket_->finish_connect() != platform::StreamStatus::kDone) return;
    write(upgrade(host, "http://" + host, pass));  // the server accepts nobody before
  }

  int handle() const override { return socket_->handle(); }

  ride::Progress establish() override {
    using platform::StreamStatus;
    const StreamStatus connected = socket_->finish_connect();
    if (connected == StreamStatus::kGone) return gone(socket_->problem());
    if (connected == StreamStatus::kLater) return ride::Progress::kWantWrite;
    if (!read()) return gone("it was refused");
    const std::size_t end = raw_.find("\r\n\r\n");
    if (end == std::string::npos) return ride::Progress::kWantRead;
    if (!raw_.starts_with("HTTP/1.1 101")) return gone(raw_.substr(0, raw_.find('\r')));
    raw_.erase(0, end + 4);
    return ride::Progress::kDone;
  }

  ride::Progress send(std::span<const std::byte> bytes, std::size_t& sent) override {
    sent = std::min<std::size_t>(bytes.size(), 16 * 1024);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), sent);
    return write(frame(2, text)) ? ride::Progress::kDone : gone(socket_->problem());
  }

  ride::Progress receive(std::span<std::byte> room, std::size_t& size) override {
    const bool open = read();
    while (take_frame()) {
    }
    size = std::min(room.size(), bytes_.size());
    for (std::size_t i = 0; i < size; ++i) room[i] = static_cast<std::byte>(bytes_[i]);
    bytes_.erase(0, size);
    if (size > 0) return ride::Progress::kDone;
    return open ? ride::Progress::kWantRead : gone("the other side has ended it");
  }

  ride::Progress wait_and_receive(std::span<std::byte> room, std::size_t& size,
                                  base::Duration limit) override {
    ride::Progress progress = receive(room, size);
    while (progress == ride::Progress::kWantRead) {
      if (socket_->wait_until_readable(limit) == platform::StreamStatus::kLater) return progress;
      progress = receive(room, size);
    }
    return progress;
  }

  void shut_down() override { socket_->shut_down(); }
  std::string other_end() const override { return socket_->other_end(); }
  std::string problem() const override { return problem_; }

 private:
  ride::Progress gone(const std::string& why) {
    problem_ = why;
    return ride::Progress::kGone;
  }

  bool write(const std::string& text) {
    std::span<const std::byte> left = std::as_bytes(std::span(text));
    while (!left.empty()) {
      std::size_t sent = 0;
      const auto status = socket_->send(left, sent);
      if (status == platform::StreamStatus::kGone) return false;
      if (status == platform::StreamStatus::kDone) left = left.subspan(sent);
      if (status == platform::StreamStatus::kLater) socket_->wait_until_writable(kPatience);
    }
    return true;
  }

  bool read() {
    std::vector<std::byte> room(1 << 16);
    std::size_t size = 0;
    const auto status = socket_->receive(room, size);
    if (status == platform::StreamStatus::kDone) {
      raw_.append(reinterpret_cast<const char*>(room.data()), size);
    }
    return status != platform::StreamStatus::kGone;
  }

  /// Frames of a server are not masked.
  bool take_frame() {
    if (raw_.size() < 2) return false;
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(raw_[at]); };
    std::size_t head = 2;
    std::size_t size = byte(1);
    if (size == 126) {
      if (raw_.size() < 4) return false;
      head = 4;
      size = static_cast<std::size_t>(byte(2)) << 8 | byte(3);
    }
    if (raw_.size() < head + size) return false;
    if ((byte(0) & 15) <= 2) bytes_ += raw_.substr(head, size);
    raw_.erase(0, head + size);
    return true;
  }

  const std::unique_ptr<platform::StreamSocket> socket_;
  std::string raw_;
  std::string bytes_;
  std::string problem_;
};

}  // namespace armature::websocket::internal
