// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "armature/can/frame.hpp"
#include "drives/canopen/abort_code.hpp"
#include "drives/canopen/little_endian.hpp"
#include "drives/canopen/object.hpp"

namespace armature::canopen::internal {

/// The frames of SDO, expedited and in segments (CiA 301, 7.2.4.3). The upper three bits of the
/// first byte say what it is.
constexpr std::size_t kSdoSize = 8;
constexpr std::size_t kExpeditedBytes = 4;
constexpr std::size_t kSegmentBytes = 7;
/// More than any parameter of a drive has; a peer can not fill the memory.
constexpr std::size_t kMostSdoBytes = 64 * 1024;

constexpr std::uint8_t kExpeditedBit = 0x02;
constexpr std::uint8_t kSizeBit = 0x01;
constexpr std::uint8_t kToggleBit = 0x10;
constexpr std::uint8_t kLastBit = 0x01;

/// What a client asks.
namespace request {
constexpr std::uint8_t kDownloadSegment = 0;
constexpr std::uint8_t kDownload = 1;
constexpr std::uint8_t kUpload = 2;
constexpr std::uint8_t kUploadSegment = 3;
}  // namespace request
/// What a server answers.
namespace response {
constexpr std::uint8_t kUploadSegment = 0;
constexpr std::uint8_t kDownloadSegment = 1;
constexpr std::uint8_t kUpload = 2;
constexpr std::uint8_t kDownload = 3;
}  // namespace response
constexpr std::uint8_t kAbort = 4;  ///< from either side

constexpr std::uint8_t specifier_of(const can::Frame& frame) {
  return static_cast<std::uint8_t>(frame.data[0] >> 5);
}
constexpr std::uint8_t command_byte(std::uint8_t specifier, unsigned rest = 0) {
  return static_cast<std::uint8_t>(unsigned{specifier} << 5 | rest);
}

constexpr Address address_of(const can::Frame& frame) {
  return {static_cast<std::uint16_t>(load(std::span(frame.data).subspan(1, 2))), frame.data[3]};
}

/// A frame that names an object, with four bytes behind.
inline can::Frame with_address(std::uint32_t id, std::uint8_t command, Address address,
                               std::uint32_t rest = 0) {
  can::Frame frame;
  frame.id = id;
  frame.size = kSdoSize;
  frame.data[0] = command;
  store(std::span(frame.data).subspan(1, 2), address.index);
  frame.data[3] = address.subindex;
  store(std::span(frame.data).subspan(4, 4), rest);
  return frame;
}

inline can::Frame abort_frame(std::uint32_t id, Address address, AbortCode code) {
  return with_address(id, command_byte(kAbort), address, static_cast<std::uint32_t>(code));
}
constexpr AbortCode abort_code_of(const can::Frame& frame) {
  return static_cast<AbortCode>(load(std::span(frame.data).subspan(4, 4)));
}

/// The frame that begins a transfer of `bytes`: up to four of them are in it.
inline can::Frame initiate_frame(std::uint32_t id, std::uint8_t specifier, Address address,
                                 std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || bytes.size() > kExpeditedBytes) {
    return with_address(id, command_byte(specifier, kSizeBit), address,
                        static_cast<std::uint32_t>(bytes.size()));
  }
  const unsigned unused = static_cast<unsigned>(kExpeditedBytes - bytes.size());
  return with_address(id, command_byte(specifier, unused << 2 | kExpeditedBit | kSizeBit), address,
                      static_cast<std::uint32_t>(load(bytes)));
}

/// Whether all of `bytes` are in the frame that begins.
constexpr bool is_expedited(const can::Frame& frame) {
  return (frame.data[0] & kExpeditedBit) != 0;
}

/// The bytes in an expedited frame; without a size all four.
constexpr std::span<const std::uint8_t> expedited_bytes(const can::Frame& frame) {
  const std::size_t unused =
      (frame.data[0] & kSizeBit) != 0 ? unsigned{frame.data[0]} >> 2 & 3u : 0u;
  return std::span(frame.data).subspan(4, kExpeditedBytes - unused);
}

/// The next up to seven of `rest` in a segment.
inline can::Frame segment_frame(std::uint32_t id, std::uint8_t specifier, bool toggle,
                                std::span<const std::uint8_t> rest) {
  const std::size_t count = std::min(rest.size(), kSegmentBytes);
  const unsigned unused = static_cast<unsigned>(kSegmentBytes - count);
  can::Frame frame;
  frame.id = id;
  frame.size = kSdoSize;
  frame.data[0] = command_byte(specifier, (toggle ? kToggleBit : 0u) | unused << 1 |
                                              (rest.size() <= kSegmentBytes ? kLastBit : 0u));
  std::copy_n(rest.begin(), count, frame.data.begin() + 1);
  return frame;
}
constexpr std::span<const std::uint8_t> segment_bytes(const can::Frame& frame) {
  return std::span(frame.data).subspan(1, kSegmentBytes - (unsigned{frame.data[0]} >> 1 & 7u));
}
constexpr bool toggle_of(const can::Frame& frame) { return (frame.data[0] & kToggleBit) != 0; }
constexpr bool is_last(const can::Frame& frame) { return (frame.data[0] & kLastBit) != 0; }

}  // namespace armature::canopen::internal
