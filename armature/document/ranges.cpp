// SPDX-License-Identifier: Apache-2.0
#include "armature/document/ranges.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <system_error>

#include "armature/document/value_tree.hpp"

namespace armature::document {
namespace {

constexpr int kMostRepetitions = 100'000;
constexpr int kLargestNumber = 1'000'000'000;

/// `{...}` without braces inside, from `begin` to `end`.
struct Braces {
  std::size_t begin;
  std::size_t end;
  std::string_view content;
};

/// The next pair of braces at or after `from` that is not `${...}`.
std::optional<Braces> next_braces(std::string_view text, std::size_t from) {
  for (std::size_t begin = text.find('{', from); begin != std::string_view::npos;
       begin = text.find('{', begin + 1)) {
    const std::size_t end = text.find_first_of("{}", begin + 1);
    if (end == std::string_view::npos) return std::nullopt;
    const bool parameter = begin > 0 && text[begin - 1] == '$';
    if (text[end] == '}' && !parameter) {
      return Braces{begin, end + 1, text.substr(begin + 1, end - begin - 1)};
    }
  }
  return std::nullopt;
}

std::optional<int> parse_number(std::string_view text) {
  int number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = failure == std::errc() && end == text.data() + text.size();
  if (!whole || number < 0 || number > kLargestNumber) return std::nullopt;
  return number;
}

/// k of `i`, `i+k` or `i-k`.
std::optional<int> parse_offset(std::string_view content) {
  if (content == "i") return 0;
  if (content.size() < 3 || content[0] != 'i') return std::nullopt;
  if (content[1] != '+' && content[1] != '-') return std::nullopt;
  const std::optional<int> distance = parse_number(content.substr(2));
  if (!distance) return std::nullopt;
  return content[1] == '+' ? *distance : -*distance;
}

bool is_range(std::string_view content) { return content.find("..") != std::string_view::npos; }

/// The range in `content`; `text` is what it stands in, for messages.
std::optional<Range> parse_range(std::string_view content, std::string_view text,
                                 const base::Location& where, base::Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& reason, std::string hint = {}) {
    diagnostics.error(where, in_quotes(text) + ": " + reason, std::move(hint));
    return std::nullopt;
  };
  const std::size_t dots = content.find("..");
  const std::optional<int> first = parse_number(content.substr(0, dots));
  const std::optional<int> last = parse_number(content.substr(dots + 2));
  if (!first || !last) {
    return refuse("a range has the form {first..last}",
                  "bounds are whole numbers or parameters: {1..${joints}}");
  }
  if (*last < *first) return refuse("the range is empty, its last number is below its first");
  if (*last - *first >= kMostRepetitions) {
    return refuse("the range has more than " + std::to_string(kMostRepetitions) + " numbers");
  }
  return Range{*first, *last};
}

}  // namespace

std::optional<RangeInText> find_range(std::string_view text, const base::Location& where,
                                      base::Diagnostics& diagnostics) {
  std::optional<Braces> braces = next_braces(text, 0);
  while (braces && !is_range(braces->content)) braces = next_braces(text, braces->end);
  if (!braces) return std::nullopt;
  const std::optional<Range> range = parse_range(braces->content, text, where, diagnostics);
  if (!range) return std::nullopt;
  return RangeInText{*range, braces->begin, braces->end};
}

bool has_range(std::string_view text) {
  for (auto braces = next_braces(text, 0); braces; braces = next_braces(text, braces->end)) {
    if (is_range(braces->content)) return true;
  }
  return false;
}

std::vector<int> number_offsets(std::string_view text) {
  std::vector<int> offsets;
  for (auto braces = next_braces(text, 0); braces; braces = next_braces(text, braces->end)) {
    if (const auto offset = parse_offset(braces->content)) offsets.push_back(*offset);
  }
  return offsets;
}

std::string replace_number(std::string_view text, int number, const base::Location& where,
                           base::Diagnostics& diagnostics) {
  std::string result;
  std::size_t copied = 0;
  for (auto braces = next_braces(text, 0); braces; braces = next_braces(text, braces->end)) {
    const std::optional<int> offset = parse_offset(braces->content);
    if (!offset) continue;
    const int value = number + *offset;
    if (value < 0) {
      diagnostics.error(where,
                        "{" + std::string(braces->content) + "} is " + std::to_string(value) +
                            " for i = " + std::to_string(number),
                        "numbers in names begin at 0");
    }
    result += text.substr(copied, braces->begin - copied);
    result += std::to_string(std::max(value, 0));
    copied = braces->end;
  }
  result += text.substr(copied);
  return result;
}

std::string range_text(const Range& range) {
  return "{" + std::to_string(range.first) + ".." + std::to_string(range.last) + "}";
}

}  // namespace armature::document
