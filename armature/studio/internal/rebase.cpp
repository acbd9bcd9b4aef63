// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/rebase.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace armature::studio::internal {
namespace {

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

std::size_t common_begin(std::string_view one, std::string_view other) {
  const std::size_t most = std::min(one.size(), other.size());
  std::size_t count = 0;
  while (count < most && one[count] == other[count]) ++count;
  // A character is changed as a whole.
  const auto inside = [&](std::string_view text) {
    return count < text.size() && continues_character(text[count]);
  };
  while (count > 0 && (inside(one) || inside(other))) --count;
  return count;
}

std::size_t common_end(std::string_view one, std::string_view other) {
  const std::size_t most = std::min(one.size(), other.size());
  std::size_t count = 0;
  while (count < most && one[one.size() - 1 - count] == other[other.size() - 1 - count]) ++count;
  while (count > 0 && continues_character(one[one.size() - count])) --count;
  return count;
}

bool are_apart(const edit::Replacement& mine, const edit::Replacement& theirs) {
  if (mine.begin == theirs.begin) return false;  // of two insertions nobody knows the order
  return mine.end <= theirs.begin || theirs.end <= mine.begin;
}

}  // namespace

Replacements difference(std::string_view before, std::string_view after) {
  if (before == after) return {};
  const std::size_t begin = common_begin(before, after);
  const std::size_t end = common_end(before.substr(begin), after.substr(begin));
  return {
      {begin, before.size() - end, std::string(after.substr(begin, after.size() - end - begin))}};
}

std::optional<Replacements> rebased(const Replacements& mine, const Replacements& theirs) {
  Replacements moved = mine;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    for (const edit::Replacement& other : theirs) {
      if (!are_apart(mine[i], other)) return std::nullopt;
      if (other.end > mine[i].begin) continue;
      const std::size_t removed = other.end - other.begin;
      moved[i].begin += other.text.size() - removed;
      moved[i].end += other.text.size() - removed;
    }
  }
  return moved;
}

}  // namespace armature::studio::internal
