// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/border.hpp"

#include <algorithm>
#include <map>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/references.hpp"

namespace armature::edit::internal {

using document::ExportKind;
using document::Range;
using document::Value;

namespace {

constexpr std::string_view kNumber = "{i}";

bool has_number(const std::string& text) { return text.find(kNumber) != text.npos; }

/// The first range in braces as `{i}`.
std::string with_number(std::string text) {
  const std::size_t open = text.find('{');
  const std::size_t close = text.rfind('}');
  const bool range = open != text.npos && close != text.npos && open < close &&
                     text.substr(open, close - open).find("..") != text.npos;
  if (range) text.replace(open, close + 1 - open, kNumber);
  return text;
}

std::string numbered(const std::string& text, int number) {
  base::Diagnostics ignored;  // no number in it is shifted
  return document::replace_number(text, number, {}, ignored);
}

/// The first `{i}` as the numbers that it runs over.
std::string with_range(std::string text, const Range& range) {
  const std::size_t at = text.find(kNumber);
  if (at != text.npos) text.replace(at, kNumber.size(), document::range_text(range));
  return text;
}

std::string short_name(const EndText& end, bool repeats) {
  return end.member + (repeats && !has_number(end.member) ? std::string(kNumber) : "");
}

std::string long_name(const EndText& end) {
  std::string name = end.component + "_" + end.member;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

const char* section_for(ExportKind kind) {
  switch (kind) {
    case ExportKind::kOperation:
      return "operations";
    case ExportKind::kEvent:
      return "events";
    case ExportKind::kProperty:
      return "properties";
    default:
      return "ports";
  }
}

}  // namespace

EndText EndText::of(const std::string& end) {
  const std::size_t dot = std::min(last_dot(end), end.size());
  EndText text{with_number(end.substr(0, dot)),
               with_number(end.substr(std::min(dot + 1, end.size()))), false};
  for (const int offset : document::number_offsets(end)) text.shifted = text.shifted || offset != 0;
  return text;
}

bool EndText::repeats() const { return has_number(component) || has_number(member); }

void Border::want(ExportKind kind, const std::string& end, const std::optional<Range>& range) {
  const EndText text = EndText::of(end);
  const auto same = [&](const Shown& one) {
    return one.kind == kind && one.end.component == text.component && one.end.member == text.member;
  };
  const auto found = std::find_if(shown_.begin(), shown_.end(), same);
  if (found == shown_.end()) {
    shown_.push_back({kind, text, text.repeats() ? range : std::nullopt, {}, false});
  } else if (found->range && range) {
    found->range = Range{std::min(found->range->first, range->first),
                         std::max(found->range->last, range->last)};
  }
}

/// All names that one of the composite's stands for.
std::vector<std::string> Border::names_of(const Shown& shown, const std::string& name) {
  if (!shown.range) return {name};
  std::vector<std::string> names;
  for (int i = shown.range->first; i <= shown.range->last; ++i) names.push_back(numbered(name, i));
  return names;
}

/// One with a range that shows the same.
const Border::Shown* Border::find_cover(const Shown& one) const {
  const std::string whole = one.end.component + "." + one.end.member;
  for (const Shown& other : shown_) {
    if (one.range || !other.range || other.kind != one.kind) continue;
    const auto names = names_of(other, other.end.component + "." + other.end.member);
    if (std::find(names.begin(), names.end(), whole) != names.end()) return &other;
  }
  return nullptr;
}

void Border::give_names() {
  std::map<std::string, int> users;
  for (Shown& one : shown_) one.covered = find_cover(one) != nullptr;
  const auto short_names = [](const Shown& one) {
    return names_of(one, short_name(one.end, one.range.has_value()));
  };
  for (const Shown& one : shown_) {
    if (one.covered) continue;
    for (const std::string& name : short_names(one)) ++users[name];
  }
  for (Shown& one : shown_) {
    const auto names = short_names(one);
    const bool unique = std::all_of(names.begin(), names.end(),
                                    [&](const std::string& name) { return users[name] <= 1; });
    one.name = unique ? short_name(one.end, one.range.has_value()) : long_name(one.end);
  }
  for (Shown& one : shown_) {
    const Shown* cover = one.covered ? find_cover(one) : nullptr;
    if (cover == nullptr) continue;
    for (int i = cover->range->first; i <= cover->range->last; ++i) {
      const std::string whole = numbered(cover->end.component + "." + cover->end.member, i);
      if (whole == one.end.component + "." + one.end.member) one.name = numbered(cover->name, i);
    }
  }
}

std::string Border::outside(ExportKind kind, const std::string& end,
                            const std::optional<Range>& range) const {
  const EndText text = EndText::of(end);
  for (const Shown& one : shown_) {
    if (one.kind != kind || one.end.component != text.component || one.end.member != text.member) {
      continue;
    }
    return composite_ + "." + (range ? with_range(one.name, *range) : one.name);
  }
  return end;
}

Value Border::exports() const {
  Value sections = document::make_map();
  for (const ExportKind kind : {ExportKind::kPort, ExportKind::kOperation, ExportKind::kEvent}) {
    Value names = document::make_map();
    for (const Shown& one : shown_) {
      if (one.kind != kind || one.covered) continue;
      const std::string name = one.range ? with_range(one.name, *one.range) : one.name;
      names.entries.push_back(
          {name, document::make_text(one.end.component + "." + one.end.member), {}, {}});
    }
    if (!names.entries.empty()) sections.entries.push_back({section_for(kind), names, {}, {}});
  }
  return sections;
}

}  // namespace armature::edit::internal
