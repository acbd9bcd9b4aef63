// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/unframer.hpp"

#include <algorithm>

namespace armature::websocket::internal {
namespace {

enum Opcode : unsigned {
  kContinuation = 0,
  kText = 1,
  kBinary = 2,
  kClose = 8,
  kPing = 9,
  kPong = 10
};

constexpr unsigned kExtended16 = 126;
constexpr unsigned kExtended64 = 127;

unsigned number_of(std::byte byte) { return std::to_integer<unsigned>(byte); }

bool is_control(unsigned opcode) { return opcode >= kClose; }

/// Of a header whose second byte is `length`.
std::size_t header_bytes(unsigned length) {
  return length == kExtended64 ? 10 : length == kExtended16 ? 4 : 2;
}

}  // namespace

bool Unframer::refuse(const char* why) {
  problem_ = why;
  return false;
}

std::size_t Unframer::unframe(std::span<std::byte> bytes) {
  std::size_t kept = 0;
  std::size_t at = 0;
  while (at < bytes.size() && problem_.empty() && !ended_) {
    if (!in_payload_) {
      if (!take_header(bytes[at++])) break;
      continue;
    }
    if (is_control(opcode_)) {
      take_control(bytes[at++]);
      continue;
    }
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size() - at));
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), size,
                bytes.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += size;
    at += size;
    left_ -= size;
    in_payload_ = left_ > 0;
  }
  return kept;
}

bool Unframer::take_header(std::byte byte) {
  header_[header_size_++] = byte;
  if (header_size_ < 2) return true;
  constexpr unsigned kMasked = 0x80;
  const unsigned length = number_of(header_[1]);
  if ((length & kMasked) != 0) return refuse("it masks its frames, as only a browser does");
  return header_size_ < header_bytes(length) || begin_payload();
}

bool Unframer::begin_payload() {
  const unsigned first = number_of(header_[0]);
  const unsigned length = number_of(header_[1]);
  opcode_ = first & 0x0f;
  left_ = length;
  if (length >= kExtended16) {
    left_ = 0;
    for (std::size_t i = 2; i < header_size_; ++i) left_ = left_ << 8 | number_of(header_[i]);
  }
  header_size_ = 0;
  control_size_ = 0;
  if ((first & 0x70) != 0) return refuse("it uses an extension that this side has not offered");
  if (opcode_ == kText) return refuse("it sent a frame of text, expected binary ones");
  const bool known = opcode_ <= kBinary || (opcode_ >= kClose && opcode_ <= kPong);
  if (!known) return refuse("it sent a frame of an unknown kind");
  if (is_control(opcode_) && (left_ > control_.size() || (first & 0x80) == 0)) {
    return refuse("it sent a control frame that is too large");
  }
  in_payload_ = left_ > 0;
  if (!in_payload_ && is_control(opcode_)) end_control();
  return true;
}

void Unframer::take_control(std::byte byte) {
  control_[control_size_++] = byte;
  in_payload_ = --left_ > 0;
  if (!in_payload_) end_control();
}

void Unframer::end_control() {
  if (opcode_ == kClose) ended_ = true;
  if (opcode_ != kPing) return;
  pinged_ = true;
  ping_ = control_;
  ping_size_ = control_size_;
}

bool Unframer::take_ping(std::array<std::byte, 125>& payload, std::size_t& size) {
  if (!pinged_) return false;
  pinged_ = false;
  payload = ping_;
  size = ping_size_;
  return true;
}

/// Behind the two bytes of its code; what others have written is not to command a terminal.
std::string Unframer::reason() const {
  std::string text;
  for (std::size_t i = 2; ended_ && i < control_size_; ++i) {
    const unsigned letter = number_of(control_[i]);
    text += letter < 0x20 || letter > 0x7e ? '?' : static_cast<char>(letter);
  }
  return text;
}

}  // namespace armature::websocket::internal
