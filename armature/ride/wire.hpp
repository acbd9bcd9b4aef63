// SPDX-License-Identifier: Apache-2.0
#pragma once

// The header of every message, and the numbers that stand for things: docs/ride.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "armature/base/hash.hpp"
#include "armature/ride/codec.hpp"

namespace armature::ride {

/// Of an operation or event: the hash of its canonical declaration.
using Number = std::uint32_t;

/// `number_of("void start()")`.
constexpr Number number_of(std::string_view canonical) { return base::fnv1a(canonical); }

/// What a message is; its number on the wire.
enum class Type : std::uint16_t { kCommand = 1, kRequest, kReply, kEvent, kControl };

std::string_view name_of(Type type);

/// How urgent a message is: 0 (background) to 255. Pending messages are dispatched most urgent
/// first, those of one priority in their order.
struct Priority {
  std::uint8_t level = 0;
  friend auto operator<=>(const Priority&, const Priority&) = default;
};

/// What a CONTROL message says, and, from 0x10000 on, what is found out on this side.
enum class Code : std::uint32_t {
  kNone = 0,
  kNoSuchComponent = 1,
  kNoSuchOperation = 2,
  kMalformed = 3,
  kBadMagic = 4,
  kTooLarge = 5,
  kNotAllowed = 6,
  kBusy = 7,
  kFailed = 8,
  kShuttingDown = 9,
  kHello = 16,
  kPing = 17,
  kPong = 18,
  kNotConnected = 0x10000,
  kDeadline = 0x10001,
  kConnectionLost = 0x10002,
};

/// `NO_SUCH_COMPONENT`; for an unknown code "code".
std::string_view name_of(Code code);

/// The header of every message.
struct Header {
  static constexpr std::size_t kSize = 16;
  static constexpr std::size_t kMostLength = 65535;
  static constexpr std::size_t kMostBody = kMostLength - kSize;
  static constexpr std::uint16_t kContinues = 0x8000;
  static constexpr std::array<char, 4> kMagic{'R', 'I', 'D', 'E'};

  std::uint32_t priority = 0;
  Type type = Type::kControl;  ///< any number below 0x8000 as it was received
  bool continues = false;      ///< the body goes on in the next message of this type and identifier
  std::uint16_t length = kSize;  ///< of the whole message [byte]
  std::uint32_t identifier = 0;

  friend bool operator==(const Header&, const Header&) = default;
};

/// @rt nonblocking, no allocation
void write_header(std::byte* to, const Header& header);

/// Nothing if the first four bytes are not the magic. Length and type are as they were sent.
/// @param from  Header::kSize bytes
/// @rt nonblocking, no allocation
std::optional<Header> read_header(const std::byte* from);

/// The body of a CONTROL message.
struct Control {
  Code code = Code::kNone;
  std::uint32_t type = 0;       ///< of the message at fault, 0 if none
  std::uint32_t recipient = 0;  ///< its identifier
  Number operation = 0;         ///< 0 if none
  std::string_view text;
};
void encode(Encoder& to, const Control& control);
bool decode(Decoder& from, Control& control);

/// Appends a message to `to`, in several where the body is larger than one can hold.
/// @param priority, type, identifier  of the header
/// @param body  what it is to hold
void append_message(Body& to, Priority priority, Type type, std::uint32_t identifier,
                    std::span<const std::byte> body);

/// Makes what was appended to `to` behind a header of `Header::kSize` bytes at `start` a message,
/// in several where it is too large for one.
/// @rt nonblocking, no allocation unless the body is larger than one message holds
void finish_message(Body& to, std::size_t start, Priority priority, Type type,
                    std::uint32_t identifier);

}  // namespace armature::ride
