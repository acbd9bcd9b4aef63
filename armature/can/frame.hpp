// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

#include "armature/base/fixed_text.hpp"
#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::can {

/// What a frame is for.
enum class FrameKind : std::uint8_t {
  kData,
  kRemote,  ///< asks for the data frame of the same identifier
  kError,   ///< made by a controller, to tell what went wrong; nobody can send it
};

/// A classic CAN frame.
struct Frame {
  static constexpr std::size_t kMostData = 8;
  static constexpr std::uint32_t kMostStandard = 0x7ff;
  static constexpr std::uint32_t kMostExtended = 0x1fffffff;

  std::uint32_t id = 0;  ///< 11 bits, 29 if extended; of an error frame: its `error_class` bits
  bool extended = false;
  FrameKind kind = FrameKind::kData;
  std::uint8_t size = 0;  ///< bytes of data; of a remote frame: how many it asks for
  std::array<std::uint8_t, kMostData> data{};

  /// The data; a remote frame has none.
  constexpr std::span<const std::uint8_t> bytes() const {
    if (kind == FrameKind::kRemote) return {};
    return {data.data(), std::min<std::size_t>(size, kMostData)};
  }

  /// What lies in `data` beyond the frame's size does not count.
  friend constexpr bool operator==(const Frame& a, const Frame& b) {
    return a.id == b.id && a.extended == b.extended && a.kind == b.kind && a.size == b.size &&
           std::ranges::equal(a.bytes(), b.bytes());
  }
};

/// What an error frame tells, in the coding of Linux: bits of its identifier.
namespace error_class {
constexpr std::uint32_t kLostArbitration = 0x002;
constexpr std::uint32_t kController = 0x004;  ///< data[1] has `controller_problem` bits
constexpr std::uint32_t kProtocol = 0x008;
constexpr std::uint32_t kNoAcknowledgement = 0x020;
constexpr std::uint32_t kBusOff = 0x040;
constexpr std::uint32_t kBusError = 0x080;
constexpr std::uint32_t kRestarted = 0x100;
}  // namespace error_class

namespace controller_problem {
constexpr std::uint8_t kReceiveOverflow = 0x01;
constexpr std::uint8_t kReceiveWarning = 0x04;  ///< many errors, but still active
constexpr std::uint8_t kSendWarning = 0x08;
constexpr std::uint8_t kReceivePassive = 0x10;
constexpr std::uint8_t kSendPassive = 0x20;
constexpr std::uint8_t kActiveAgain = 0x40;
}  // namespace controller_problem

/// The first eight bytes of `bytes` go in; the identifier is taken as it is.
constexpr Frame data_frame(std::uint32_t id, std::span<const std::uint8_t> bytes) {
  Frame frame;
  frame.id = id;
  frame.size = static_cast<std::uint8_t>(std::min(bytes.size(), Frame::kMostData));
  std::copy_n(bytes.begin(), frame.size, frame.data.begin());
  return frame;
}
constexpr Frame data_frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  return data_frame(id, std::span(bytes.begin(), bytes.size()));
}
constexpr Frame extended_frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  Frame frame = data_frame(id, bytes);
  frame.extended = true;
  return frame;
}
constexpr Frame remote_frame(std::uint32_t id, std::uint8_t size) {
  return {.id = id, .extended = false, .kind = FrameKind::kRemote, .size = size, .data = {}};
}

/// Whether a controller can send it: a data or remote frame whose identifier and size fit.
constexpr bool can_be_sent(const Frame& frame) {
  return frame.kind != FrameKind::kError && frame.size <= Frame::kMostData &&
         frame.id <= (frame.extended ? Frame::kMostExtended : Frame::kMostStandard);
}

/// The 32 bits by which frames compete for the bus, in the order of the wire (base identifier, RTR
/// or SRR, IDE, rest of the identifier, RTR): of several, the frame with the smallest wins.
constexpr std::uint32_t arbitration_word(const Frame& frame) {
  const std::uint32_t remote = frame.kind == FrameKind::kRemote ? 1u : 0u;
  if (!frame.extended) return frame.id << 21 | remote << 20;
  const std::uint32_t base_id = frame.id >> 18;
  const std::uint32_t rest = frame.id & 0x3ffffu;
  return base_id << 21 | 1u << 20 | 1u << 19 | rest << 1 | remote;
}

/// Bits of a frame that are never stuffed: CRC delimiter, acknowledgement and its delimiter, end of
/// frame, and the three bits until another may begin.
constexpr int kFrameTailBits = 1 + 1 + 1 + 7 + 3;

/// The exact number of bits that a data or remote frame takes on the wire, from its start to where
/// the next may begin: with the stuff bits of its own content and checksum.
/// @rt nonblocking, no allocation, O(bits)
int frame_bits(const Frame& frame);

/// How long `bits` take, rounded to the nanosecond.
/// @param bit_rate  bits per second, > 0
constexpr base::Duration bits_time(std::int64_t bits, std::uint32_t bit_rate) {
  return base::Duration((bits * 1'000'000'000 + bit_rate / 2) / bit_rate);
}

/// How long a data or remote frame occupies the wire.
/// @rt nonblocking, no allocation, O(bits)
inline base::Duration frame_time(const Frame& frame, std::uint32_t bit_rate) {
  return bits_time(frame_bits(frame), bit_rate);
}

/// A frame as candump writes it: `123#DEADBEEF`, `12345678#`, `123#R`, `123#R4`,
/// `20000040#0000000000000000` for an error frame.
/// @rt nonblocking, no allocation
base::FixedText<32> to_text(const Frame& frame);

/// The frame of such a text; bytes may be separated by dots. The error says what was expected.
base::Result<Frame> parse_frame(std::string_view text);

}  // namespace armature::can
