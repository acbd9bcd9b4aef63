// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace armature::websocket::internal {

/// Takes the bytes out of the frames of a server (RFC 6455, 5.2), however they are divided.
/// @rt no allocation unless there is a problem
/// @thread one at a time
class Unframer {
 public:
  /// Moves the payload of binary frames in `bytes` to its begin.
  /// @return how many bytes of payload there are; what comes behind `ended` or a problem is dropped
  std::size_t unframe(std::span<std::byte> bytes);

  /// A ping's payload, which is owed to the other side; none: no ping came. It is taken once.
  bool take_ping(std::array<std::byte, 125>& payload, std::size_t& size);
  /// The other side has said that it ends the connection.
  bool ended() const { return ended_; }
  /// What it said why.
  std::string reason() const;
  /// What is no frame of a node; empty: nothing.
  const std::string& problem() const { return problem_; }

 private:
  bool take_header(std::byte byte);
  bool begin_payload();
  void take_control(std::byte byte);
  void end_control();
  bool refuse(const char* why);

  std::array<std::byte, 10> header_{};
  std::size_t header_size_ = 0;
  bool in_payload_ = false;
  std::uint64_t left_ = 0;  ///< of the payload
  unsigned opcode_ = 0;
  std::array<std::byte, 125> control_{};  ///< what a control frame carries
  std::size_t control_size_ = 0;
  std::array<std::byte, 125> ping_{};
  std::size_t ping_size_ = 0;
  bool pinged_ = false;
  bool ended_ = false;
  std::string problem_;
};

}  // namespace armature::websocket::internal
