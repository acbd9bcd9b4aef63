// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: a client that says what it is told to, right or wrong.

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "armature/ride/internal/assembler.hpp"
#include "armature/ride/internal/directory.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride {

class RawClient {
 public:
  explicit RawClient(const Address& address)
      : connection_(std::move(make_tcp_transport()->connect(address)).value()) {
    while (connection_->establish() != Progress::kDone) {
    }
  }

  /// The other end of a connection that was accepted.
  explicit RawClient(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}

  int handle() const { return connection_->handle(); }
  void send(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      std::size_t sent = 0;
      if (connection_->send(bytes, sent) == Progress::kGone) return;
      bytes = bytes.subspan(sent);
    }
  }
  template <typename... T>
  void send(Priority priority, Type type, std::uint32_t identifier, const T&... fields) {
    send(message(priority, type, identifier, fields...).bytes());
  }
  template <typename... T>
  static Body message(Priority priority, Type type, std::uint32_t identifier, const T&... fields) {
    Body bytes;
    bytes.extend(Header::kSize);
    Encoder to(bytes);
    (to.put(fields), ...);
    finish_message(bytes, 0, priority, type, identifier);
    return bytes;
  }

  struct Received {
    Header header;
    std::vector<std::byte> body;
  };
  /// The next message; none once the connection has ended, or if there is none for long.
  std::optional<Received> receive() {
    internal::Message message;
    while (assembler_.next(message) != internal::Found::kMessage) {
      std::size_t size = 0;
      const Progress progress =
          connection_->wait_and_receive(assembler_.room(), size, std::chrono::seconds(20));
      if (progress != Progress::kDone) return std::nullopt;
      assembler_.received(size);
    }
    return Received{message.header, {message.body.begin(), message.body.end()}};
  }
  /// The next message, which is a CONTROL message.
  struct Refusal {
    std::uint32_t call = 0;
    Code code = Code::kNone;
    std::uint32_t type = 0;
    std::uint32_t recipient = 0;
    Number operation = 0;
    std::string text;
  };
  Refusal receive_control() {
    const auto received = receive();
    if (!received || received->header.type != Type::kControl) return {};
    Decoder from(received->body);
    Control control;
    if (!from.take(control) || !from.ended()) return {};
    return {received->header.identifier, control.code,      control.type,
            control.recipient,           control.operation, std::string(control.text)};
  }
  /// The result of the REPLY that is next.
  template <typename T>
  std::optional<T> receive_reply(std::uint32_t call) {
    const auto received = receive();
    if (!received || received->header.type != Type::kReply || received->header.identifier != call) {
      return std::nullopt;
    }
    Decoder from(received->body);
    T value{};
    if (!from.take(value) || !from.ended()) return std::nullopt;
    return value;
  }
  std::optional<std::int32_t> subscribe(std::int32_t component, Number event,
                                        std::int32_t subscription) {
    send({}, Type::kRequest, internal::kDirectory, internal::kSubscribe, 1u, component, event,
         subscription);
    return receive_reply<std::int32_t>(1);
  }

 private:
  std::unique_ptr<Connection> connection_;
  internal::Assembler assembler_{64 << 20};
};

}  // namespace armature::ride
