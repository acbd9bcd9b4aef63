// SPDX-License-Identifier: Apache-2.0
#include "armature/base/visible_text.hpp"

#include <cstdio>

#include "armature/base/utf8.hpp"

namespace armature::base {
namespace {

bool is_control(char32_t value) {
  if (value == '\t' || value == '\n') return false;
  return value < 0x20 || (value >= 0x7f && value < 0xa0);
}

bool turns_direction(char32_t value) {
  return value == 0x061c || value == 0x200e || value == 0x200f ||
         (value >= 0x2028 && value <= 0x202e) || (value >= 0x2066 && value <= 0x2069);
}

std::string written_out(char32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, value < 0x100 ? "\\x%02x" : "\\u%04x",
                static_cast<unsigned>(value));
  return text;
}

}  // namespace

std::string visible_text(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const auto next = code_point_at(text, at);
    const std::size_t end = next ? next->end : at + 1;
    const char32_t value = next ? next->value : static_cast<unsigned char>(text[at]);
    if (next && !is_control(value) && !turns_direction(value)) {
      shown += text.substr(at, end - at);
    } else {
      shown += written_out(value);
    }
    at = end;
  }
  return shown;
}

}  // namespace armature::base
