// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/unified_diff.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace armature::edit {
namespace {

constexpr std::size_t kContext = 3;

using Lines = std::vector<std::string_view>;

/// With their ends; the last one may have none.
Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t size = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
  return lines;
}

/// Lines [begin, end) before, and those in their place after.
struct Block {
  std::size_t begin;
  std::size_t end;
  std::size_t begin_after;
  std::size_t end_after;
};

/// Byte offsets at which the lines begin.
std::vector<std::size_t> begins_of(const Lines& lines) {
  std::vector<std::size_t> begins;
  std::size_t begin = 0;
  for (const std::string_view line : lines) {
    begins.push_back(begin);
    begin += line.size();
  }
  return begins;
}

/// What stands between lines that no replacement touches.
std::vector<Block> blocks_of(const FileChange& change, const Lines& before, const Lines& after) {
  const std::vector<std::size_t> begins = begins_of(after);
  std::vector<Block> blocks;
  Block next{0, 0, 0, 0};
  const auto keep = [&](std::size_t line, std::size_t line_after) {
    next.end = line;
    next.end_after = line_after;
    if (next.begin < next.end || next.begin_after < next.end_after) blocks.push_back(next);
    next = {line + 1, 0, line_after + 1, 0};
  };
  auto replacement = change.replacements.begin();
  std::size_t begin = 0;
  std::size_t added = 0;
  std::size_t removed = 0;
  for (std::size_t i = 0; i < before.size(); begin += before[i++].size()) {
    for (; replacement != change.replacements.end() && replacement->end <= begin; ++replacement) {
      added += replacement->text.size();
      removed += replacement->end - replacement->begin;
    }
    const bool touched =
        replacement != change.replacements.end() && replacement->begin < begin + before[i].size();
    const auto found = std::lower_bound(begins.begin(), begins.end(), begin + added - removed);
    const auto line = static_cast<std::size_t>(found - begins.begin());
    const bool same =
        found != begins.end() && *found == begin + added - removed && after[line] == before[i];
    if (!touched && same) keep(i, line);
  }
  keep(before.size(), after.size());
  return blocks;
}

void add_lines(std::string& text, char mark, const Lines& lines, std::size_t begin,
               std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    text += mark + std::string(lines[i]);
    if (!lines[i].ends_with('\n')) text += "\n\\ No newline at end of file\n";
  }
}

std::string range_of(std::size_t begin, std::size_t end) {
  const std::size_t size = end - begin;
  const std::string first = std::to_string(size == 0 ? begin : begin + 1);
  return size == 1 ? first : first + "," + std::to_string(size);
}

/// Blocks whose lines around them meet, as one.
std::string hunk(const std::vector<Block>& blocks, std::size_t first, std::size_t last,
                 const Lines& before, const Lines& after) {
  const std::size_t lead = std::min(kContext, blocks[first].begin);
  const std::size_t tail = std::min(kContext, before.size() - blocks[last].end);
  std::string text = "@@ -" + range_of(blocks[first].begin - lead, blocks[last].end + tail) + " +" +
                     range_of(blocks[first].begin_after - lead, blocks[last].end_after + tail) +
                     " @@\n";
  std::size_t shown = blocks[first].begin - lead;
  for (std::size_t i = first; i <= last; ++i) {
    add_lines(text, ' ', before, shown, blocks[i].begin);
    add_lines(text, '-', before, blocks[i].begin, blocks[i].end);
    add_lines(text, '+', after, blocks[i].begin_after, blocks[i].end_after);
    shown = blocks[i].end;
  }
  add_lines(text, ' ', before, shown, shown + tail);
  return text;
}

}  // namespace

std::string unified_diff(const FileChange& change) {
  const Lines before = lines_of(change.before);
  const Lines after = lines_of(change.after);
  const std::vector<Block> blocks = blocks_of(change, before, after);
  std::string text = "--- " + change.file + "\n+++ " + change.file + "\n";
  for (std::size_t first = 0; first < blocks.size();) {
    std::size_t last = first;
    while (last + 1 < blocks.size() && blocks[last + 1].begin < blocks[last].end + 2 * kContext) {
      ++last;
    }
    text += hunk(blocks, first, last, before, after);
    first = last + 1;
  }
  return text;
}

}  // namespace armature::edit
