// SPDX-License-Identifier: Apache-2.0
#include "armature/document/source_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "armature/base/utf8.hpp"

namespace armature::document {
namespace {

std::string hexadecimal(unsigned char byte) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%02X", static_cast<unsigned>(byte));
  return text.data();
}

/// False and an error where git left both sides of a conflict.
bool check_conflicts(std::string_view text, const std::string& file,
                     base::Diagnostics& diagnostics) {
  for (const std::string_view mark : {"<<<<<<< ", ">>>>>>> "}) {
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + 1)) {
      if (at > 0 && text[at - 1] != '\n') continue;
      diagnostics.error(LineIndex(text, file).at(at),
                        "git left a conflict here, from <<<<<<< to >>>>>>>",
                        "keep one of its two sides and remove the marks");
      return false;
    }
  }
  return true;
}

}  // namespace

LineIndex::LineIndex(std::string_view text, std::string file)
    : file_(std::move(file)), size_(text.size()), line_starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts_.push_back(i + 1);
  }
}

base::Location LineIndex::at(std::size_t offset) const {
  offset = std::min(offset, size_);
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto line = next - line_starts_.begin();
  return {file_, static_cast<int>(line), static_cast<int>(offset - *(next - 1)) + 1};
}

std::string_view line_of(std::string_view text, int line) {
  for (int skipped = 1; skipped < line; ++skipped) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

bool is_forbidden_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
}

bool check_source_text(std::string_view text, const std::string& file, std::size_t limit_bytes,
                       base::Diagnostics& diagnostics) {
  if (text.size() > limit_bytes) {
    diagnostics.error({file, 0, 0}, "the file has " + std::to_string(text.size()) +
                                        " bytes; at most " + std::to_string(limit_bytes) +
                                        " are read");
    return false;
  }
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const auto character = base::code_point_at(text, at);
    if (!character) {
      diagnostics.error(LineIndex(text, file).at(at),
                        "byte " + hexadecimal(byte) + " is not valid UTF-8",
                        "save the file as UTF-8");
      return false;
    }
    if (is_forbidden_control(text[at])) {
      diagnostics.error(LineIndex(text, file).at(at),
                        "control character " + hexadecimal(byte) + " in a text file");
      return false;
    }
    at = character->end;
  }
  return check_conflicts(text, file, diagnostics);
}

}  // namespace armature::document
