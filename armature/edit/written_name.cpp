// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/written_name.hpp"

#include <algorithm>
#include <utility>

namespace armature::edit::internal {
namespace {

/// A name behind the composite instance that it is a part of, as deep as the key is.
std::string own_level(const std::string& name, const std::string& key) {
  const auto dots = std::count(key.begin(), key.end(), '.');
  std::size_t begin = name.size();
  for (auto left = dots + 1; left > 0 && begin != name.npos; --left) {
    begin = begin == 0 ? name.npos : name.rfind('.', begin - 1);
  }
  return begin == name.npos ? name : name.substr(begin + 1);
}

/// The key's text without dots of ranges, which are in braces.
std::string without_braces(const WrittenName& name) { return name.begin + name.end; }

}  // namespace

WrittenName WrittenName::of(std::string_view text) {
  std::size_t open = text.find('{');
  const std::size_t close = text.rfind('}');
  if (open == text.npos || close == text.npos || close < open) return {std::string(text), {}, {}};
  if (open > 0 && text[open - 1] == '$') --open;
  return {std::string(text.substr(0, open)), std::string(text.substr(open, close + 1 - open)),
          std::string(text.substr(close + 1))};
}

EntryNames::EntryNames(const Entry& entry)
    : written_(WrittenName::of(entry.key->text)), composite_(entry.composite) {
  for (const std::string& name : entry.names) {
    names_.push_back(composite_.empty() ? name : own_level(name, without_braces(written_)));
  }
}

EntryNames::EntryNames(std::string key) : written_{key, {}, {}}, names_{std::move(key)} {}

std::optional<EntryNames::Meant> EntryNames::find_number(std::string_view name) const {
  if (!name.starts_with(written_.begin)) return std::nullopt;
  const std::string_view rest = name.substr(written_.begin.size());
  if (written_.braces.empty()) {
    if (rest.empty() || rest[0] == '.') return Meant{{}, {}, std::string(rest)};
    return std::nullopt;
  }
  const bool braced = rest.starts_with('{') || rest.starts_with("${");
  const std::size_t size =
      braced ? rest.rfind('}') + 1 : std::min(rest.find_first_not_of("0123456789"), rest.size());
  if (size == 0 || !rest.substr(size).starts_with(written_.end)) return std::nullopt;
  const std::string_view behind = rest.substr(size + written_.end.size());
  if (!behind.empty() && behind[0] != '.') return std::nullopt;
  const std::string number{rest.substr(0, size)};
  const std::string whole = written_.begin + number + written_.end;
  const bool known = braced || std::find(names_.begin(), names_.end(), whole) != names_.end();
  if (!known) return std::nullopt;
  return Meant{number, {}, std::string(behind)};
}

std::optional<EntryNames::Meant> EntryNames::find_key(const std::string& key) const {
  std::optional<Meant> found = find_number(key);
  if (found && !found->behind.empty()) found.reset();
  return found;
}

std::optional<EntryNames::Meant> EntryNames::find(const std::string& name,
                                                  const std::string& composite,
                                                  const SourceMap& map,
                                                  const document::Document& document) const {
  if (composite == composite_) return find_number(name);
  if (composite_.empty()) {
    const auto& entries = map.entries();
    const bool shadowed = std::any_of(entries.begin(), entries.end(), [&](const Entry& entry) {
      return entry.composite == composite && find_key(entry.key->text).has_value();
    });
    return shadowed ? std::nullopt : find_number(name);
  }
  if (!composite.empty()) return std::nullopt;
  for (const document::Composite& instance : document.composites) {
    const std::string before = instance.name + ".";
    if (instance.model != composite_ || !name.starts_with(before)) continue;
    std::optional<Meant> found = find_number(std::string_view(name).substr(before.size()));
    if (found) found->before = before;
    return found;
  }
  return std::nullopt;
}

}  // namespace armature::edit::internal
