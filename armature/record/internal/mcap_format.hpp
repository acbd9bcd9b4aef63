// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

/// The parts that MCAP files are made of, as https://mcap.dev/spec names them.
namespace armature::record::internal::mcap {

static_assert(std::endian::native == std::endian::little, "MCAP is little-endian");

inline constexpr std::string_view kMagic = "\x89MCAP0\r\n";

enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// What precedes the content of a record: its kind and its length.
inline constexpr std::size_t kRecordHead = sizeof(Op) + sizeof(std::uint64_t);
inline constexpr std::size_t kFooterContent = 8 + 8 + 4;
inline constexpr std::size_t kFooterRecord = kRecordHead + kFooterContent;
inline constexpr std::size_t kDataEndRecord = kRecordHead + 4;

inline constexpr std::string_view kMessageEncoding = "json";
inline constexpr std::string_view kSchemaEncoding = "jsonschema";
inline constexpr std::string_view kRosProfile = "ros2";
inline constexpr std::string_view kCdrEncoding = "cdr";
inline constexpr std::string_view kRosSchemaEncoding = "ros2msg";

/// The CRC-32 of what `crc` is the one of, followed by `bytes`; of nothing it is 0.
std::uint32_t crc32(std::uint32_t crc, std::string_view bytes);

template <std::unsigned_integral T>
void put(T number, std::string& to) {
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  to.append(bytes, sizeof number);
}

/// A text, a map or an array, after the count of its bytes.
inline void put_counted(std::string_view bytes, std::string& to) {
  put(static_cast<std::uint32_t>(bytes.size()), to);
  to += bytes;
}

inline void put_record(Op op, std::string_view content, std::string& to) {
  put(static_cast<std::uint8_t>(op), to);
  put(std::uint64_t{content.size()}, to);
  to += content;
}

/// Takes parts off the front of bytes; false if there are too few.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  template <std::unsigned_integral T>
  bool take(T& number) {
    if (rest_.size() < sizeof number) return false;
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
    return true;
  }

  bool take_counted(std::string_view& bytes) {
    std::uint32_t count = 0;
    return take(count) && take_bytes(count, bytes);
  }

  bool take_record(Op& op, std::string_view& content) {
    std::uint8_t code = 0;
    std::uint64_t size = 0;
    if (!take(code) || !take(size)) return false;
    op = static_cast<Op>(code);
    return take_bytes(size, content);
  }

  bool take_bytes(std::uint64_t count, std::string_view& bytes) {
    if (count > rest_.size()) return false;
    const auto size = static_cast<std::size_t>(count);
    bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }

  std::string_view rest() const { return rest_; }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

}  // namespace armature::record::internal::mcap
