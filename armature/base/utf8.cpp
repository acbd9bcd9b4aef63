// SPDX-License-Identifier: Apache-2.0
#include "armature/base/utf8.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace armature::base {
namespace {

struct Span {
  char32_t first;
  char32_t last;
};

// The blocks of East Asian Width W and F (Unicode annex 11), as far as documentation has them.
constexpr Span kWide[] = {{0x1100, 0x115f}, {0x2e80, 0xa4cf},   {0xac00, 0xd7a3},
                          {0xf900, 0xfaff}, {0xfe30, 0xfe6f},   {0xff00, 0xff60},
                          {0xffe0, 0xffe6}, {0x1f300, 0x1faff}, {0x20000, 0x3fffd}};
constexpr Span kCombining[] = {{0x0300, 0x036f}, {0x200b, 0x200f}, {0xfe00, 0xfe0f}};

template <std::size_t N>
bool is_in(const Span (&spans)[N], char32_t value) {
  return std::any_of(std::begin(spans), std::end(spans),
                     [&](const Span& span) { return value >= span.first && value <= span.last; });
}

/// Bytes of a sequence that begins with `lead`; 0 if none does.
std::size_t sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return 2;
  if (lead >= 0xe0 && lead < 0xf0) return 3;
  if (lead >= 0xf0 && lead < 0xf5) return 4;
  return 0;
}

/// Whether eight bytes of ASCII come first: a long text takes an eighth of the time.
bool begins_with_ascii_word(std::string_view text) {
  std::uint64_t word = 0;
  if (text.size() < sizeof word) return false;
  std::memcpy(&word, text.data(), sizeof word);
  return (word & 0x8080808080808080u) == 0;
}

}  // namespace

std::optional<CodePoint> code_point_at(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = sequence_length(lead);
  if (length == 0 || length > text.size() - at) return std::nullopt;
  if (length == 1) return CodePoint{lead, at + 1};
  char32_t value = lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues_character(text[at + i])) return std::nullopt;
    value = (value << 6) | (static_cast<unsigned char>(text[at + i]) & 0x3fu);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = value >= 0xd800 && value <= 0xdfff;
  if (value < kLeast[length] || surrogate || value > 0x10ffff) return std::nullopt;
  return CodePoint{value, at + length};
}

std::size_t valid_utf8_length(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (begins_with_ascii_word(text.substr(at))) {
      at += sizeof(std::uint64_t);
      continue;
    }
    const auto next = code_point_at(text, at);
    if (!next) return at;
    at = next->end;
  }
  return at;
}

bool is_utf8(std::string_view text) { return valid_utf8_length(text) == text.size(); }

std::size_t character_count(std::string_view text) {
  const auto continued = std::count_if(text.begin(), text.end(), continues_character);
  return text.size() - static_cast<std::size_t>(continued);
}

std::size_t columns_of(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto next = code_point_at(text, at);
    if (!next) return columns + text.size() - at;
    if (is_in(kWide, next->value)) {
      columns += 2;
    } else if (!is_in(kCombining, next->value)) {
      columns += 1;
    }
    at = next->end;
  }
  return columns;
}

}  // namespace armature::base
