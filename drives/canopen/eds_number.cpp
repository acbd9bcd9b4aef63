// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/internal/eds_number.hpp"

#include <charconv>
#include <optional>
#include <string>

#include "armature/base/visible_text.hpp"
#include "drives/canopen/internal/ini.hpp"

namespace armature::canopen::internal {
namespace {

constexpr std::string_view kNodeId = "$nodeid";

std::string_view without_outer_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::optional<std::int64_t> parse_plain(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  int base = 10;
  if (text.starts_with("0x")) {
    base = 16;
    text.remove_prefix(2);
  } else if (text.size() > 1 && text.front() == '0') {
    base = 8;
    text.remove_prefix(1);
  }
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (negative && value > std::uint64_t{1} << 63) return std::nullopt;
  return static_cast<std::int64_t>(negative ? ~value + 1 : value);
}

}  // namespace

base::Result<std::int64_t> parse_eds_number(std::string_view text, NodeId node) {
  const std::string lower = lower_case(text);
  const std::string_view whole = without_outer_blanks(lower);
  std::string_view rest = whole;
  bool adds_node = false;
  if (rest == kNodeId) return std::int64_t{node};
  const std::size_t plus = rest.find('+');
  if (plus != std::string_view::npos) {
    const std::string_view left = without_outer_blanks(rest.substr(0, plus));
    const std::string_view right = without_outer_blanks(rest.substr(plus + 1));
    adds_node = left == kNodeId || right == kNodeId;
    if (adds_node) rest = left == kNodeId ? right : left;
  }
  const auto value = parse_plain(rest);
  if (value) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(*value) + (adds_node ? node : 0u));
  }
  return base::Error{"expected a number such as 12, 0x1A or $NODEID+0x180, found '" +
                     base::visible_text(whole) + "'"};
}

}  // namespace armature::canopen::internal
