// SPDX-License-Identifier: Apache-2.0
#include "armature/document/fields.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

#include "armature/base/alternatives.hpp"
#include "armature/base/near_name.hpp"
#include "armature/base/seconds.hpp"
#include "armature/base/unit.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/types/elements.hpp"

namespace armature::document {
namespace {

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool continues_name(char c) {
  return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) || c == '-';
}

constexpr const char* kNameRule =
    "a name has letters, digits, '_' and '-' and begins with a letter";

}  // namespace

bool is_name(std::string_view text) {
  return !text.empty() && begins_name(text[0]) &&
         std::all_of(text.begin(), text.end(), continues_name);
}

bool is_dotted_name(std::string_view text) {
  for (std::size_t dot = text.find('.'); dot != std::string_view::npos; dot = text.find('.')) {
    if (!is_name(text.substr(0, dot))) return false;
    text.remove_prefix(dot + 1);
  }
  return is_name(text);
}

std::pair<std::string, std::string> split_last_dot(std::string_view text) {
  const std::size_t dot = text.rfind('.');
  if (dot == std::string_view::npos) return {"", std::string(text)};
  return {std::string(text.substr(0, dot)), std::string(text.substr(dot + 1))};
}

std::vector<const Value*> items_of(const Value* value) {
  if (value == nullptr) return {};
  if (value->kind != Value::Kind::kList) return {value};
  std::vector<const Value*> items;
  for (const Value& item : value->items) items.push_back(&item);
  return items;
}

void ValueReader::error(const base::Location& where, std::string_view message,
                        base::Hint hint) const {
  diagnostics_.error(where, owner_ + ": " + std::string(message), std::move(hint));
}

std::optional<std::string> ValueReader::text(const Value& value, std::string_view what) const {
  if (value.kind == Value::Kind::kText) return value.text;
  error(value.where,
        std::string(what) + " must be text, found " + std::string(name_of(value.kind)));
  return std::nullopt;
}

std::optional<std::string> ValueReader::name(const Value& value, std::string_view what) const {
  std::optional<std::string> found = text(value, what);
  if (!found || is_name(*found)) return found;
  error(value.where, std::string(what) + " " + in_quotes(*found) + " is not a valid name",
        kNameRule);
  return std::nullopt;
}

std::optional<std::string> ValueReader::dotted_name(const Value& value,
                                                    std::string_view what) const {
  std::optional<std::string> found = text(value, what);
  if (!found || is_dotted_name(*found)) return found;
  error(value.where, std::string(what) + " " + in_quotes(*found) + " is not a valid name",
        kNameRule);
  return std::nullopt;
}

std::optional<bool> ValueReader::flag(const Value& value, std::string_view what) const {
  return choice<bool>(value, what, {{"true", true}, {"false", false}});
}

std::optional<int> ValueReader::whole_number(const Value& value, std::string_view what, int least,
                                             int most) const {
  const std::optional<std::string> found = text(value, what);
  if (!found) return std::nullopt;
  int number = 0;
  const char* end = found->data() + found->size();
  const auto [stopped, failure] = std::from_chars(found->data(), end, number);
  if (failure == std::errc() && stopped == end && number >= least && number <= most) return number;
  error(value.where, std::string(what) + " must be a whole number from " + std::to_string(least) +
                         " to " + std::to_string(most) + ", found " + in_quotes(*found));
  return std::nullopt;
}

std::optional<base::Duration> ValueReader::duration(const Value& value,
                                                    std::string_view what) const {
  constexpr double kLongestSeconds = 1e6;
  const std::optional<std::string> found = text(value, what);
  if (!found) return std::nullopt;
  const auto refuse = [&](const std::string& message) {
    error(value.where, std::string(what) + " " + message + ", found " + in_quotes(*found),
          "for example 10 ms");
    return std::nullopt;
  };
  const base::Result<base::Quantity> quantity = base::parse_quantity(*found);
  if (!quantity) {
    error(value.where, std::string(what) + ": " + quantity.error(), "for example 10 ms");
    return std::nullopt;
  }
  if (quantity.value().unit.empty()) return refuse("must be a duration with its unit");
  const base::Result<double> seconds =
      base::convert(quantity.value().value, quantity.value().unit, "s");
  if (!seconds.ok()) return refuse("must be a duration");
  if (seconds.value() <= 0.0) return refuse("must be a duration above 0");
  const bool possible = seconds.value() >= 1e-9 && seconds.value() <= kLongestSeconds;
  if (!possible) return refuse("must be from 1 ns to 1000000 s");
  return base::from_seconds(seconds.value());
}

void ValueReader::refuse_name(const Value& value, std::string_view what,
                              const types::Type& type) const {
  refuse_choice(value, what, value.text, types::enumerator_names(type));
}

void ValueReader::refuse_choice(const Value& value, std::string_view what, const std::string& found,
                                const std::vector<std::string>& known) const {
  error(value.where,
        std::string(what) + " must be " + base::alternatives(known) + ", found " + in_quotes(found),
        base::near_hint(found, known));
}

Fields::Fields(const Value& value, const ValueReader& reader, Empty empty)
    : value_(value), reader_(reader), empty_(empty) {
  known_.reserve(kUsualKeys);
  const bool possible = value.kind == Value::Kind::kMap || value.kind == Value::Kind::kNone;
  if (possible) return;
  reader.error(value.where, "expected a map of keys, found " + std::string(name_of(value.kind)));
}

const Value* Fields::take(std::string_view key) {
  known_.emplace_back(key);
  const Property* entry = find(value_.entries, key);
  const bool given = entry != nullptr && entry->value.kind != Value::Kind::kNone;
  return given ? &entry->value : nullptr;
}

void Fields::refuse_others() const {
  for (const Property& entry : value_.entries) {
    const bool known = std::find(known_.begin(), known_.end(), entry.name) != known_.end();
    const bool unset = entry.value.kind == Value::Kind::kNone && !entry.value.literal;
    if (!known) {
      reader_.error(entry.where, "unknown key " + in_quotes(entry.name),
                    base::suggestion(entry.name, known_));
    } else if (unset && empty_ == Empty::kRefused) {
      reader_.error(entry.where, in_quotes(entry.name) + " has no value",
                    "give it one, or remove the key");
    }
  }
}

}  // namespace armature::document
