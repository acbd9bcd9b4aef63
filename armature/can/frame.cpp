// SPDX-License-Identifier: Apache-2.0
#include "armature/can/frame.hpp"

#include <optional>
#include <string>

namespace armature::can {
namespace {

constexpr std::uint32_t kErrorFlag = 0x20000000;
constexpr std::size_t kStandardDigits = 3;
constexpr std::size_t kExtendedDigits = 8;

/// Takes the bits of a frame in the order of the wire; counts them with the stuff bits and computes
/// the checksum.
class WireBits {
 public:
  /// The `width` lowest bits of `value`, highest first.
  void put(std::uint32_t value, int width) {
    for (int i = width - 1; i >= 0; --i) {
      const bool bit = (value >> i & 1u) != 0;
      add_to_checksum(bit);
      put_stuffed(bit);
    }
  }

  void put_checksum() {
    const std::uint32_t checksum = checksum_;
    put(checksum, 15);
  }

  int count() const { return count_; }

 private:
  /// After five equal bits, stuff bits included, comes one of the other kind.
  void put_stuffed(bool bit) {
    ++count_;
    run_ = bit == last_ ? run_ + 1 : 1;
    last_ = bit;
    if (run_ < 5) return;
    ++count_;
    run_ = 1;
    last_ = !bit;
  }

  void add_to_checksum(bool bit) {
    constexpr std::uint32_t kPolynomial = 0x4599;
    const bool divides = bit != ((checksum_ >> 14 & 1u) != 0);
    checksum_ = checksum_ << 1 & 0x7fffu;
    if (divides) checksum_ ^= kPolynomial;
  }

  int count_ = 0;
  int run_ = 0;
  bool last_ = true;  // an idle bus is recessive; its bits do not count for stuffing
  std::uint32_t checksum_ = 0;
};

void put_identifier(const Frame& frame, WireBits& bits) {
  const std::uint32_t remote = frame.kind == FrameKind::kRemote ? 1u : 0u;
  if (!frame.extended) {
    bits.put(frame.id, 11);
    bits.put(remote << 2, 3);  // RTR, IDE, r0
  } else {
    bits.put(frame.id >> 18, 11);
    bits.put(0b11, 2);  // SRR, IDE
    bits.put(frame.id, 18);
    bits.put(remote << 2, 3);  // RTR, r1, r0
  }
}

void append_hex(base::FixedText<32>& text, std::uint32_t value, std::size_t digits) {
  for (std::size_t i = digits; i-- > 0;) {
    text.append(std::string_view(&"0123456789ABCDEF"[value >> 4 * i & 0xfu], 1));
  }
}

std::optional<std::uint32_t> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
  if (c >= 'A' && c <= 'F') return static_cast<std::uint32_t>(c - 'A' + 10);
  if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a' + 10);
  return std::nullopt;
}

std::optional<std::uint32_t> hex_number(std::string_view digits) {
  std::uint32_t value = 0;
  for (const char c : digits) {
    const auto digit = hex_digit(c);
    if (!digit) return std::nullopt;
    value = value << 4 | *digit;
  }
  return value;
}

base::Error bad_frame(std::string_view text, const std::string& expected) {
  return base::Error{"frame '" + std::string(text) + "': " + expected};
}

/// Leaves in `frame` what stands before the '#'; says what was expected otherwise.
base::Result<void> parse_identifier(std::string_view digits, Frame& frame) {
  const auto id = hex_number(digits);
  if (!id || (digits.size() != kStandardDigits && digits.size() != kExtendedDigits)) {
    return base::Error{"expected 3 or 8 hexadecimal digits before '#', found '" +
                       std::string(digits) + "'"};
  }
  frame.id = *id;
  if (digits.size() == kExtendedDigits && (*id & kErrorFlag) != 0) {
    frame.kind = FrameKind::kError;
    frame.id = *id & ~kErrorFlag;
  } else {
    frame.extended = digits.size() == kExtendedDigits;
  }
  const bool standard = digits.size() == kStandardDigits;
  if (frame.id <= (standard ? Frame::kMostStandard : Frame::kMostExtended)) return {};
  return base::Error{standard ? "expected an identifier of 11 bits, at most 7FF"
                              : "expected an identifier of 29 bits, at most 1FFFFFFF"};
}

base::Result<void> parse_remote(std::string_view size, Frame& frame) {
  if (frame.kind == FrameKind::kError) {
    return base::Error{"expected data, since an error frame cannot be remote"};
  }
  frame.kind = FrameKind::kRemote;
  if (size.empty()) return {};
  if (size.size() != 1 || size[0] < '0' || size[0] > '8') {
    return base::Error{"expected nothing or a size from 0 to 8 behind 'R', found '" +
                       std::string(size) + "'"};
  }
  frame.size = static_cast<std::uint8_t>(size[0] - '0');
  return {};
}

base::Result<void> parse_data(std::string_view text, Frame& frame) {
  while (!text.empty()) {
    if (text[0] == '.' && frame.size > 0 && text.size() > 1) text.remove_prefix(1);
    const auto byte = hex_number(text.substr(0, 2));
    if (text.size() < 2 || !byte) {
      return base::Error{"expected two hexadecimal digits for each byte, found '" +
                         std::string(text) + "'"};
    }
    if (frame.size == Frame::kMostData) return base::Error{"expected at most 8 bytes of data"};
    frame.data[frame.size++] = static_cast<std::uint8_t>(*byte);
    text.remove_prefix(2);
  }
  return {};
}

}  // namespace

int frame_bits(const Frame& frame) {
  WireBits bits;
  bits.put(0, 1);  // start of frame
  put_identifier(frame, bits);
  bits.put(frame.size, 4);
  for (const std::uint8_t byte : frame.bytes()) bits.put(byte, 8);
  bits.put_checksum();
  return bits.count() + kFrameTailBits;
}

base::FixedText<32> to_text(const Frame& frame) {
  base::FixedText<32> text;
  const bool is_error = frame.kind == FrameKind::kError;
  append_hex(text, is_error ? frame.id | kErrorFlag : frame.id,
             frame.extended || is_error ? kExtendedDigits : kStandardDigits);
  text.append("#");
  if (frame.kind == FrameKind::kRemote) {
    text.append("R");
    if (frame.size > 0) append_hex(text, frame.size, 1);
  }
  for (const std::uint8_t byte : frame.bytes()) append_hex(text, byte, 2);
  return text;
}

base::Result<Frame> parse_frame(std::string_view text) {
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos) {
    return bad_frame(text, "expected '#' between identifier and data");
  }
  const std::string_view content = text.substr(hash + 1);
  if (content.starts_with('#')) {
    return bad_frame(text, "expected a classic frame, found one of CAN FD ('##')");
  }
  Frame frame;
  auto parsed = parse_identifier(text.substr(0, hash), frame);
  if (parsed && content.starts_with('R')) {
    parsed = parse_remote(content.substr(1), frame);
  } else if (parsed) {
    parsed = parse_data(content, frame);
  }
  if (!parsed) return bad_frame(text, parsed.error());
  return frame;
}

}  // namespace armature::can
