// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/deploy/internal/expand_document.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;
namespace {

constexpr std::array<std::string_view, 2> kEnds = {"from", "to"};

/// The texts of `from` and `to`, as far as they are there.
std::vector<const Value*> ends_of(const Value& connection) {
  std::vector<const Value*> ends;
  for (const std::string_view key : kEnds) {
    const Property* entry = find(connection.entries, key);
    if (entry != nullptr && !entry->value.literal) ends.push_back(&entry->value);
  }
  return ends;
}

/// `Joint{i+1}` as `Joint{i}` and 1; nothing if the component's name has no such number.
struct Pattern {
  std::string name;
  int offset;
  std::string component;
};

std::optional<Pattern> pattern_of(const std::string& end) {
  const std::string component = split_last_dot(end).first;
  const std::vector<int> offsets = number_offsets(component);
  if (offsets.size() != 1) return std::nullopt;
  const std::size_t begin = component.find("{i");
  const std::size_t close = component.find('}', begin);
  return Pattern{component.substr(0, begin) + "{i}" + component.substr(close + 1), offsets[0],
                 component};
}

std::optional<Repetition> explicit_repetition(const std::vector<const Value*>& ends,
                                              base::Diagnostics& diagnostics) {
  std::optional<Range> range;
  for (const Value* end : ends) {
    if (!has_range(end->text)) continue;
    const std::optional<RangeInText> found = find_range(end->text, end->where, diagnostics);
    if (!found) return std::nullopt;
    if (range && *range != found->range) {
      diagnostics.error(end->where,
                        "connection: range " + range_text(found->range) + " does not fit " +
                            range_text(*range) + " at its other end",
                        "write the range once and {i} elsewhere");
      return std::nullopt;
    }
    range = found->range;
    std::string rest = end->text;
    rest.erase(found->begin, found->end - found->begin);
    if (has_range(rest)) {
      diagnostics.error(end->where, "connection: " + in_quotes(end->text) + " has two ranges",
                        "write the range once and {i} elsewhere");
      return std::nullopt;
    }
  }
  return range ? Repetition{*range, true} : Repetition{};
}

void refuse_pattern(const Value& end, const RangesByPattern& ranges,
                    base::Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const auto& [name, all] : ranges) known.push_back(name);
  const auto pattern = pattern_of(end.text);
  base::Hint hint = pattern ? base::near_hint(pattern->name, known) : base::Hint();
  if (hint.empty()) hint = "write a range, for example {1..3}, in place of {i}";
  diagnostics.error(end.where, "connection: {i} in " + in_quotes(end.text) + " has no range",
                    std::move(hint));
}

/// Where the components that the ends name with `{i}` all exist.
std::optional<Repetition> implied_repetition(const std::vector<const Value*>& ends,
                                             const RangesByPattern& ranges,
                                             base::Diagnostics& diagnostics) {
  std::optional<Range> common;
  std::optional<std::pair<std::string, Range>> whole;  // of a component without offset
  for (const Value* end : ends) {
    const std::optional<Pattern> pattern = pattern_of(end->text);
    const auto found = pattern ? ranges.find(pattern->name) : ranges.end();
    if (found == ranges.end()) continue;
    if (found->second.size() > 1) {
      diagnostics.error(end->where,
                        "connection: " + in_quotes(pattern->component) + " has several ranges",
                        "write the one that is meant, for example {1..3}, in place of {i}");
      return std::nullopt;
    }
    const Range own = found->second.front();
    const Range shifted{own.first - pattern->offset, own.last - pattern->offset};
    if (pattern->offset == 0 && whole && whole->second != own) {
      diagnostics.error(end->where,
                        "connection: " + pattern->name + " runs over " + range_text(own) + " but " +
                            whole->first + " over " + range_text(whole->second),
                        "write the range that is meant, for example {1..3}, in place of {i}");
      return std::nullopt;
    }
    if (pattern->offset == 0) whole = {pattern->name, own};
    common =
        common ? Range{std::max(common->first, shifted.first), std::min(common->last, shifted.last)}
               : shifted;
  }
  if (!common) {
    const auto numbered = std::find_if(ends.begin(), ends.end(), [](const Value* end) {
      return !number_offsets(end->text).empty();
    });
    refuse_pattern(**numbered, ranges, diagnostics);
    return std::nullopt;
  }
  common->first = std::max(common->first, 0);
  if (common->last < common->first) {
    diagnostics.error(ends.front()->where, "connection: no {i} exists at both ends");
    return std::nullopt;
  }
  return Repetition{*common, true};
}

}  // namespace

std::optional<Repetition> find_repetition(const Value& connection, const RangesByPattern& ranges,
                                          base::Diagnostics& diagnostics) {
  const std::vector<const Value*> ends = ends_of(connection);
  const std::optional<Repetition> written = explicit_repetition(ends, diagnostics);
  if (!written || written->repeated) return written;
  const bool numbered = std::any_of(ends.begin(), ends.end(), [](const Value* end) {
    return !number_offsets(end->text).empty();
  });
  if (!numbered) return written;
  return implied_repetition(ends, ranges, diagnostics);
}

Value without_range(Value connection) {
  base::Diagnostics ignored;  // find_repetition has reported what is wrong
  for (const std::string_view key : kEnds) {
    Property* entry = find(connection.entries, key);
    if (entry == nullptr) continue;
    const auto found = find_range(entry->value.text, entry->value.where, ignored);
    if (found) entry->value.text.replace(found->begin, found->end - found->begin, "{i}");
  }
  return connection;
}

}  // namespace armature::deploy::internal
