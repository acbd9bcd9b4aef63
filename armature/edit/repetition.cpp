// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/repetition.hpp"

#include <algorithm>
#include <charconv>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/references.hpp"
#include "armature/edit/internal/with_parameters.hpp"
#include "armature/edit/internal/written_name.hpp"

namespace armature::edit::internal {

using document::Range;

namespace {

std::optional<int> number_of(std::string_view digits) {
  int number = 0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), number);
  const bool whole = error == std::errc() && end == digits.end();
  return whole ? std::optional(number) : std::nullopt;
}

/// The entry's range, moved to what `{i}` is when `{i+offset}` runs over it.
std::optional<Range> range_behind(const EndPattern& pattern, const std::string& composite,
                                  const Workshop& shop) {
  for (const Entry& entry : shop.map().entries()) {
    if (entry.changes || entry.composite != composite) continue;
    if (pattern_of(entry) != pattern.component) continue;
    const std::optional<Range> range = range_of(entry);
    if (range) return Range{range->first - pattern.offset, range->last - pattern.offset};
  }
  return std::nullopt;
}

}  // namespace

std::string pattern_of(const Entry& entry) {
  const WrittenName name = WrittenName::of(entry.key->text);
  return name.braces.find("..") == name.braces.npos ? "" : name.begin + "{i}" + name.end;
}

std::optional<Range> range_of(const Entry& entry) {
  const WrittenName name = WrittenName::of(entry.key->text);
  if (pattern_of(entry).empty() || name.begin.find('$') != name.begin.npos) return std::nullopt;
  std::optional<Range> range;
  for (const std::string& full : entry.names) {
    const std::size_t level = entry.composite.empty() ? 0 : full.rfind('.') + 1;
    const std::size_t beside = level + name.begin.size() + name.end.size();
    if (full.size() <= beside) return std::nullopt;
    const auto number =
        number_of(std::string_view(full).substr(level + name.begin.size(), full.size() - beside));
    if (!number) return std::nullopt;
    range = range ? Range{std::min(range->first, *number), std::max(range->last, *number)}
                  : Range{*number, *number};
  }
  return range;
}

std::optional<EndPattern> pattern_of_end(const std::string& end) {
  std::string component = end.substr(0, std::min(last_dot(end), end.size()));
  const std::size_t open = component.find('{');
  const std::size_t close = component.rfind('}');
  if (open == component.npos || close == component.npos || close < open) return std::nullopt;
  const std::string braces = component.substr(open, close + 1 - open);
  const bool range = braces.find("..") != braces.npos;
  const std::vector<int> offsets = document::number_offsets(braces);
  if (!range && offsets.size() != 1) return std::nullopt;
  component.replace(open, braces.size(), "{i}");
  return EndPattern{component, range ? 0 : offsets.front()};
}

std::optional<Range> repetition_of(const ConnectionEntry& entry, const WrittenEnds& ends,
                                   const Workshop& shop) {
  base::Diagnostics ignored;  // the document has no errors
  std::optional<Range> common;
  for (const std::string& end : {ends.from, ends.to}) {
    const auto found =
        document::find_range(with_parameters(end, shop.document().parameters), {}, ignored);
    if (found) return found->range;
  }
  for (const std::string& end : {ends.from, ends.to}) {
    const std::optional<EndPattern> pattern = pattern_of_end(end);
    const std::optional<Range> own =
        pattern ? range_behind(*pattern, entry.composite, shop) : std::nullopt;
    if (!own) continue;
    common = common ? Range{std::max(common->first, own->first), std::min(common->last, own->last)}
                    : own;
  }
  if (common) common->first = std::max(common->first, 0);
  return common;
}

}  // namespace armature::edit::internal
