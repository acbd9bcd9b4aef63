// SPDX-License-Identifier: Apache-2.0
#include "armature/document/typed_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <system_error>

#include "armature/document/value_tree.hpp"

namespace armature::document {
namespace {

template <typename Number>
std::optional<Number> parse(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

bool is_whole(std::string_view text) {
  return parse<std::int64_t>(text).has_value() || parse<std::uint64_t>(text).has_value();
}

bool all_texts(const Value& list) {
  return std::all_of(list.items.begin(), list.items.end(),
                     [](const Value& item) { return item.kind == Value::Kind::kText; });
}

/// The type of a list is that of its elements: they need none of their own. A list of lists or
/// maps has none, and what the elements show themselves need not be said.
void normalise_list_type(Value& list) {
  if (!all_texts(list)) list.type.clear();
  if (list.type.empty()) return;
  for (Value& item : list.items) item.type.clear();
  if (list.type == shown_list_type(list)) list.type.clear();
}

}  // namespace

bool is_simple_type(std::string_view type) {
  constexpr std::array<std::string_view, 15> kTypes = {
      "boolean", "char",   "uchar",    "octet",     "short",  "ushort", "long",  "ulong",
      "llong",   "ullong", "longlong", "ulonglong", "double", "float",  "string"};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

bool is_list_type(std::string_view type) { return !element_type_of(type).empty(); }

bool is_struct_type(std::string_view type) {
  const bool other_use = is_simple_type(type) || is_list_type(type) || type == "literal";
  return !type.empty() && !other_use && std::all_of(type.begin(), type.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-./:").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

std::string_view element_type_of(std::string_view list_type) {
  if (list_type == "array") return "double";
  if (list_type == "ints") return "long";
  return list_type == "strings" ? "string" : "";
}

bool is_text_type(std::string_view type) {
  return type == "string" || type == "char" || type == "uchar" || type == "octet";
}

std::string_view shown_type(std::string_view text) {
  if (text == "true" || text == "false") return "boolean";
  if (const auto whole = parse<std::int64_t>(text)) {
    const bool small = *whole >= std::numeric_limits<std::int32_t>::min() &&
                       *whole <= std::numeric_limits<std::int32_t>::max();
    return small ? "long" : "llong";
  }
  if (parse<std::uint64_t>(text)) return "ullong";
  const bool digits = text.find_first_of("0123456789") != std::string_view::npos;
  return digits && parse<double>(text) ? "double" : "string";
}

std::string_view shown_list_type(const Value& list) {
  const bool numbers = std::all_of(list.items.begin(), list.items.end(), [](const Value& item) {
    return item.kind == Value::Kind::kText && item.type.empty() && parse<double>(item.text);
  });
  return numbers ? "array" : "strings";
}

std::string wrong_with(std::string_view text, std::string_view type) {
  if (type == "boolean") {
    const bool known = text == "0" || text == "1" || text == "true" || text == "false";
    return known ? "" : "must be 0, 1, true or false";
  }
  if (type == "double" || type == "float") return parse<double>(text) ? "" : "must be a number";
  if (type == "string") return "";
  if (is_text_type(type)) return text.size() <= 1 ? "" : "must be one character";
  return is_whole(text) ? "" : "must be a whole number";
}

std::string wrong_with(const Value& value) {
  if (value.type.empty()) return {};
  const bool text = value.kind == Value::Kind::kText;
  const std::string_view expected =
      text ? std::string_view(value.type) : element_type_of(value.type);
  for (const Value& one : text ? std::vector<Value>{value} : value.items) {
    const std::string wrong = wrong_with(one.text, expected);
    if (!wrong.empty()) return wrong + ", found " + in_quotes(one.text);
  }
  return {};
}

void normalise_type(Value& value) {
  if (value.kind == Value::Kind::kList) {
    normalise_list_type(value);
    return;
  }
  if (value.kind != Value::Kind::kText || value.type.empty()) return;
  if (!is_text_type(value.type)) value.text = std::string(trimmed(value.text));
  if (value.type == "boolean" && value.text == "0") value.text = "false";
  if (value.type == "boolean" && value.text == "1") value.text = "true";
  if (value.type == "double" && is_whole(value.text)) value.text += ".0";
  if (value.type == shown_type(value.text)) value.type.clear();
}

}  // namespace armature::document
