// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/element_text.hpp"
#include "armature/edit/internal/repetition.hpp"
#include "armature/edit/internal/scalar_text.hpp"
#include "armature/edit/internal/targets.hpp"
#include "armature/edit/internal/written_name.hpp"

namespace armature::edit::internal {
namespace {

using document::make_text;
using document::Range;

/// A range as its key has it: `{1..${joints}}`.
struct WrittenRange {
  std::string first;
  std::string last;
  Range numbers;  ///< that it stands for
};

/// Some of the components of an entry, as an entry of their own.
struct Piece {
  std::string key;
  std::optional<int> number;  ///< of the only one
};

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

std::optional<WrittenRange> range_in(const Entry& entry, Workshop& shop) {
  const std::string braces = WrittenName::of(entry.key->text).braces;
  const std::optional<Range> numbers = range_of(entry);
  const std::size_t dots = braces.find("..");
  if (!numbers || dots == braces.npos || braces.ends_with("{i}")) {
    shop.refuse(entry.file->place_of(*entry.key), "'" + entry.key->text + "' is no range");
    return std::nullopt;
  }
  return WrittenRange{braces.substr(1, dots - 1), braces.substr(dots + 2, braces.size() - dots - 3),
                      *numbers};
}

/// `3` or `3..5`, inside of the range and not all of it.
std::optional<Range> part_of(const Split& split, const WrittenRange& range, Workshop& shop) {
  const std::size_t dots = split.part.find("..");
  const std::string first = split.part.substr(0, dots);
  const std::string last = dots == split.part.npos ? first : split.part.substr(dots + 2);
  constexpr std::size_t kMostDigits = 9;
  const bool numbers =
      is_number(first) && is_number(last) && std::max(first.size(), last.size()) <= kMostDigits;
  const Range part = numbers ? Range{std::stoi(first), std::stoi(last)} : Range{0, -1};
  const Range& all = range.numbers;
  const std::string whole = document::range_text(all);
  if (part.last < part.first || part.first < all.first || part.last > all.last) {
    shop.refuse("'" + split.part + "' is no number and no part of " + whole,
                "write a number, 3, or a part, 3..5");
    return std::nullopt;
  }
  if (part == all) {
    shop.refuse("'" + split.part + "' is all of " + whole, "write a part of it");
    return std::nullopt;
  }
  return part;
}

Piece piece_of(const WrittenName& name, const std::string& first, const std::string& last) {
  const bool single = first == last && is_number(first);
  const std::string middle = single ? first : "{" + first + ".." + last + "}";
  return {name.begin + middle + name.end, single ? std::optional(std::stoi(first)) : std::nullopt};
}

std::vector<Piece> pieces_of(const Entry& entry, const WrittenRange& range, const Range& part) {
  const WrittenName name = WrittenName::of(entry.key->text);
  const bool from_first = part.first == range.numbers.first;
  const bool to_last = part.last == range.numbers.last;
  std::vector<Piece> pieces;
  if (!from_first) {
    pieces.push_back(piece_of(name, range.first, std::to_string(part.first - 1)));
  }
  const bool several = part.first < part.last;  // these keep the parameters of the range
  pieces.push_back(piece_of(name, several && from_first ? range.first : std::to_string(part.first),
                            several && to_last ? range.last : std::to_string(part.last)));
  if (!to_last) pieces.push_back(piece_of(name, std::to_string(part.last + 1), range.last));
  return pieces;
}

/// The entry as one of a piece: of a single component `{i}` is its number.
std::string text_of(const Piece& piece, const Entry& entry, bool first) {
  CopyChanges changes;
  changes.anchors = first;  // an anchor is given once
  changes.new_value = [&](const Node& scalar) -> std::optional<document::Value> {
    if (&scalar == entry.key) return make_text(piece.key);
    if (!piece.number || document::number_offsets(scalar.text).empty()) return std::nullopt;
    base::Diagnostics ignored;  // the reader of the new text finds it
    return make_text(document::replace_number(scalar.text, *piece.number, {}, ignored));
  };
  return copied_element(*entry.file, *entry.key, changes);
}

/// The end with a range in place of its first `{i}`; nothing if it has none.
std::optional<std::string> with_range(const std::string& end, const std::string& range) {
  const std::size_t at = end.find("{i}");
  if (at == end.npos) return std::nullopt;
  return std::string(end).replace(at, 3, range);
}

/// Where `{i}` runs over the range, a connection needs the numbers: the entries have several.
void write_range(const ConnectionEntry& connection, const WrittenEnds& ends, const Entry& entry,
                 const WrittenRange& range, bool keeps_parameters, Workshop& shop) {
  const std::optional<Range> numbers = repetition_of(connection, ends, shop);
  const bool whole = keeps_parameters && numbers && *numbers == range.numbers;
  const std::string braces = whole ? WrittenName::of(entry.key->text).braces
                                   : document::range_text(numbers.value_or(Range{}));
  const auto from = with_range(ends.from, braces);
  const auto to = from ? std::nullopt : with_range(ends.to, braces);
  if (!numbers || (!from && !to)) {
    shop.refuse(connection.file->place_of(*connection.item),
                "the connection's {i} runs over it, and no end has a plain {i} for the numbers",
                "write the range there first");
  } else if (shop.require(*connection.file, *connection.item, "the connection")) {
    write_ends(connection, from.value_or(ends.from), to.value_or(ends.to), shop);
  }
}

bool runs_over(const std::string& end, const Entry& entry) {
  const std::optional<EndPattern> pattern = pattern_of_end(end);
  return pattern && pattern->component == pattern_of(entry);
}

void write_connections(const Entry& entry, const WrittenRange& range, const Range& part,
                       Workshop& shop) {
  const bool keeps_first = is_number(range.first) || part.first != range.numbers.first;
  const bool keeps_last = is_number(range.last) || part.last != range.numbers.last;
  const bool keeps_parameters = part.first < part.last || (keeps_first && keeps_last);
  for (const ConnectionEntry& connection : shop.map().connections()) {
    if (connection.composite != entry.composite) continue;
    const WrittenEnds ends = ends_of(*connection.item);
    const bool explicit_range = (ends.from + ends.to).find("..") != std::string::npos;
    if (explicit_range || (!runs_over(ends.from, entry) && !runs_over(ends.to, entry))) continue;
    write_range(connection, ends, entry, range, keeps_parameters, shop);
  }
}

}  // namespace

void draft(const Split& split, Workshop& shop) {
  const Entry* entry = find_whole_entry(split.name, shop);
  if (entry == nullptr) return;
  const std::optional<WrittenRange> range = range_in(*entry, shop);
  if (!range) return;
  const std::optional<Range> part = part_of(split, *range, shop);
  if (!part || !shop.require(*entry->file, *entry->key, "'" + split.name + "'")) return;
  std::vector<std::string> texts;
  for (const Piece& piece : pieces_of(*entry, *range, *part)) {
    texts.push_back(text_of(piece, *entry, texts.empty()));
  }
  shop.layout(*entry->file).replace_element(*entry->key, texts);
  write_connections(*entry, *range, *part, shop);
  shop.expect(
      [&before = shop.before()](const State&, base::Diagnostics&) { return before.document; });
}

}  // namespace armature::edit::internal
