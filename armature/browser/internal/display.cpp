// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/display.hpp"

#include <algorithm>
#include <cstdio>

#include "armature/base/utf8.hpp"

namespace armature::browser::internal {
namespace {

const char* code_of(Ink ink) {
  switch (ink) {
    case Ink::kName:
      return "\x1b[36m";
    case Ink::kHeading:
      return "\x1b[1m";
    case Ink::kBad:
      return "\x1b[31m";
    case Ink::kGood:
      return "\x1b[32m";
    case Ink::kFaint:
      return "\x1b[2m";
  }
  return "";
}

/// Counts columns, of colours none.
struct ColumnCounter {
  std::size_t columns = 0;
  bool in_escape = false;

  void add(char c) {
    if (c == '\x1b') in_escape = true;
    if (!in_escape && !base::continues_character(c)) ++columns;
    if (c == 'm') in_escape = false;
  }
};

/// Where to end a line that may have `room` columns.
std::size_t line_end(std::string_view text, std::size_t room) {
  ColumnCounter counter;
  std::size_t blank = std::string_view::npos;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ' ' && counter.columns > 0) blank = i;
    counter.add(text[i]);
    if (counter.columns > room) {
      return blank != std::string_view::npos ? blank : std::max<std::size_t>(i, 1);
    }
  }
  return text.size();
}

}  // namespace

std::string number_text(const char* format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

std::string inked(const Paper& paper, Ink ink, std::string_view text) {
  if (!paper.colour || text.empty()) return std::string(text);
  return code_of(ink) + std::string(text) + "\x1b[0m";
}

std::string in_quotes(std::string_view text) {
  std::string safe = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '\n') {
      safe += "\\n";
    } else if (c == '"' || c == '\\') {
      safe += std::string("\\") + c;
    } else if (code < 0x20 || code == 0x7f) {
      safe += "\\" + std::to_string(code);
    } else {
      safe += c;
    }
  }
  return safe + "\"";
}

std::string with_unit(std::string_view text, std::string_view unit) {
  return unit.empty() ? std::string(text) : std::string(text) + " " + std::string(unit);
}

std::size_t columns_of(std::string_view text) {
  ColumnCounter counter;
  for (const char c : text) counter.add(c);
  return counter.columns;
}

std::string wrapped(const Paper& paper, std::string_view text, std::size_t indent,
                    std::size_t first_indent) {
  constexpr std::size_t kLeastRoom = 16;
  std::string lines;
  std::size_t at = first_indent;
  while (true) {
    const std::size_t room = std::max(paper.width, at + kLeastRoom) - at;
    const std::size_t end = line_end(text, room);
    const std::size_t last = text.substr(0, end).find_last_not_of(' ');
    lines += text.substr(0, last == std::string_view::npos ? 0 : last + 1);
    while (!text.empty() && text.size() > end && text[end] == ' ') text.remove_prefix(1);
    text.remove_prefix(end);
    if (text.empty()) return lines;
    lines += "\n" + std::string(indent, ' ');
    at = indent;
  }
}

std::string in_columns(const Paper& paper, const std::vector<std::string>& words) {
  std::size_t widest = 1;
  for (const std::string& word : words) widest = std::max(widest, columns_of(word));
  const std::size_t beside = std::max<std::size_t>(1, (paper.width + 1) / (widest + 2));
  const std::size_t rows = (words.size() + beside - 1) / beside;
  std::string text;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = row; i < words.size(); i += rows) {
      text += words[i];
      if (i + rows < words.size()) text += std::string(widest + 2 - columns_of(words[i]), ' ');
    }
    if (row + 1 < rows) text += "\n";
  }
  return text;
}

std::string table(const Paper& paper, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      widths[i] = std::max(widths[i], columns_of(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::size_t at = 0;
    if (!text.empty()) text += "\n";
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      text += row[i] + std::string(widths[i] + 2 - columns_of(row[i]), ' ');
      at += widths[i] + 2;
    }
    if (!row.empty()) text += wrapped(paper, row.back(), std::min(at, paper.width / 2), at);
  }
  return text;
}

}  // namespace armature::browser::internal
