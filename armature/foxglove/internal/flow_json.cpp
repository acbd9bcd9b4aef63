// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/flow_json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace armature::foxglove::internal {
namespace {

constexpr int kMostDepth = 32;

/// Reads what types::to_text writes.
class FlowReader {
 public:
  explicit FlowReader(std::string_view text) : rest_(text) {}

  /// Nothing if it is no such text.
  std::optional<Json> whole() {
    auto json = value(0);
    skip_blanks();
    return rest_.empty() ? json : std::nullopt;
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool takes(char wanted) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != wanted) return false;
    rest_.remove_prefix(1);
    return true;
  }

  std::optional<Json> value(int depth) {
    if (depth > kMostDepth) return std::nullopt;
    if (takes('[')) return list(depth);
    if (takes('{')) return structure(depth);
    if (takes('"')) return quoted();
    return word();
  }

  std::optional<Json> list(int depth) {
    Json all = Json::array();
    if (takes(']')) return all;
    do {
      auto one = value(depth + 1);
      if (!one) return std::nullopt;
      all.push_back(*std::move(one));
    } while (takes(','));
    return takes(']') ? std::optional(all) : std::nullopt;
  }

  std::optional<Json> structure(int depth) {
    Json all = Json::object();
    if (takes('}')) return all;
    do {
      skip_blanks();
      const std::size_t end = rest_.find(':');
      if (end == std::string_view::npos) return std::nullopt;
      const std::string name(rest_.substr(0, end));
      rest_.remove_prefix(end + 1);
      auto one = value(depth + 1);
      if (!one) return std::nullopt;
      all[name] = *std::move(one);
    } while (takes(','));
    return takes('}') ? std::optional(all) : std::nullopt;
  }

  std::optional<Json> quoted() {
    std::string text;
    while (!rest_.empty() && rest_.front() != '"') {
      const bool escaped = rest_.front() == '\\';
      if (escaped) rest_.remove_prefix(1);
      if (rest_.empty()) return std::nullopt;
      const char one = rest_.front();
      rest_.remove_prefix(1);
      text += escaped ? meant_by(one) : one;
    }
    return takes('"') ? std::optional<Json>(text) : std::nullopt;
  }

  /// What is behind a backslash.
  char meant_by(char escaped) {
    if (escaped == 'n') return '\n';
    if (escaped == 't') return '\t';
    if (escaped != 'x' || rest_.size() < 2) return escaped;
    unsigned char byte = '?';
    std::from_chars(rest_.data(), rest_.data() + 2, byte, 16);
    rest_.remove_prefix(2);
    return static_cast<char>(byte);
  }

  std::optional<Json> word() {
    const std::size_t end = std::min(rest_.find_first_of(",]} "), rest_.size());
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end);
    if (text.empty()) return std::nullopt;
    if (text == "true" || text == "false") return Json(text == "true");
    std::int64_t integer = 0;
    if (read(text, integer)) return Json(integer);
    std::uint64_t natural = 0;
    if (read(text, natural)) return Json(natural);
    double number = 0.0;
    if (!read(text, number)) return Json(std::string(text));
    return std::isfinite(number) ? Json(number) : Json(nullptr);
  }

  template <typename Number>
  static bool read(std::string_view text, Number& number) {
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && last == end;
  }

  std::string_view rest_;
};

void append_text(const std::string& text, std::string& to) {
  to += '"';
  for (const char one : text) {
    if (one == '"' || one == '\\') to += '\\';
    to += one;
  }
  to += '"';
}

base::Result<void> append_json(const Json& json, std::string& to, int depth) {
  if (depth > kMostDepth) return base::Error{"the value is nested too deeply"};
  if (json.is_string()) {
    append_text(json.get<std::string>(), to);
  } else if (json.is_boolean() || json.is_number()) {
    to += json.dump();
  } else if (json.is_array() || json.is_object()) {
    const bool object = json.is_object();
    to += object ? '{' : '[';
    bool first = true;
    for (const auto& [name, one] : json.items()) {
      if (!std::exchange(first, false)) to += ", ";
      if (object) to += name + ": ";
      if (auto done = append_json(one, to, depth + 1); !done) return done;
    }
    to += object ? '}' : ']';
  } else {
    return base::Error{"expected a number, a text, true or false, a list or an object, found " +
                       json.dump()};
  }
  return {};
}

}  // namespace

Json json_of_text(const Shape& shape, const std::string& text) {
  const bool plain = shape.kind == Shape::Kind::kText || shape.kind == Shape::Kind::kEnumeration;
  if (plain) return text;
  auto json = FlowReader(text).whole();
  return json ? *std::move(json) : Json(text);
}

base::Result<std::string> text_of_json(const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  std::string text;
  const auto done = append_json(json, text, 0);
  if (!done) return base::Error{done.error()};
  return text;
}

}  // namespace armature::foxglove::internal
