// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/layout.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "armature/base/utf8.hpp"

namespace armature::idl::internal {
namespace {

std::string blanks(std::size_t count) { return std::string(count, ' '); }

/// Text that begins at some column, and what clang-format thinks of it.
struct Packed {
  std::string text;
  std::size_t breaks = 0;
  bool fits = true;
};

/// Items one after the other from `column` on, in lines that begin at `indent`.
Packed pack(std::size_t column, std::size_t indent, const Items& items, std::string_view separator,
            const std::string& tail) {
  Packed packed;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool last = i + 1 == items.size();
    const std::string item = items[i] + (last ? tail : std::string(separator));
    const std::size_t width = base::columns_of(item);
    const std::size_t blank = i == 0 ? 0 : 1;
    if (i > 0 && column + blank + width > kColumns) {
      packed.text += "\n" + blanks(indent);
      column = indent;
      ++packed.breaks;
    } else {
      packed.text += blanks(blank);
      column += blank;
    }
    packed.text += item;
    column += width;
    packed.fits = packed.fits && column <= kColumns;
  }
  if (items.empty()) {
    packed.text = tail;
    packed.fits = column + base::columns_of(tail) <= kColumns;
  }
  return packed;
}

/// One way to lay something out.
struct Way {
  std::string text;
  std::size_t penalty = 0;
};

/// What clang-format 14 charges for breaks inside parentheses: all that is paid before, each
/// comma, and the one right behind the parenthesis. The first break costs kFirstBreak more.
struct Prices {
  std::size_t before = 0;
  std::size_t each = 0;
  std::size_t behind_parenthesis = 0;
};
constexpr std::size_t kFirstBreak = 15;
constexpr std::size_t kBehindOnlyArgument = 59;
constexpr Prices kDeclaration{0, 41, 140};
constexpr Prices kDeclarationBelowResult{200, 41, 140};
constexpr Prices kCall{0, 41, 41};
constexpr Prices kDeeper{0, 61, 80};

void consider(std::optional<Way>& best, const Packed& packed, const std::string& before,
              std::size_t penalty) {
  if (!packed.fits) return;
  if (!best || penalty < best->penalty) best = Way{before + packed.text + "\n", penalty};
}

/// Head and parameters, which are aligned behind the parenthesis or begin on a line of their own.
void consider_both(std::optional<Way>& best, std::size_t indent, const std::string& before,
                   const std::string& head, const Items& items, const std::string& tail,
                   const Prices& prices) {
  const std::size_t column = indent + base::columns_of(head);
  if (column > kColumns) return;
  const Packed aligned = pack(column, column, items, ",", tail);
  const std::size_t first = aligned.breaks == 0 ? 0 : kFirstBreak;
  consider(best, aligned, before + blanks(indent) + head,
           prices.before + first + aligned.breaks * prices.each);
  if (items.empty()) return;
  const Packed below = pack(indent + 4, indent + 4, items, ",", tail);
  consider(best, below, before + blanks(indent) + head + "\n" + blanks(indent + 4),
           prices.before + kFirstBreak + prices.behind_parenthesis + below.breaks * prices.each);
}

}  // namespace

std::string function(std::size_t indent, const Function& function) {
  const std::string name = function.owner + function.name + "(";
  const std::string result = function.result.empty() ? "" : function.result + " ";
  const std::string tail = ")" + function.tail;
  std::optional<Way> best;
  consider_both(best, indent, "", result + name, function.parameters, tail, kDeclaration);
  if (!function.result.empty()) {
    consider_both(best, indent, blanks(indent) + function.result + "\n", name, function.parameters,
                  tail, kDeclarationBelowResult);
  }
  if (best) return best->text;
  const Packed too_long = pack(indent + 4, indent + 4, function.parameters, ",", tail);
  return blanks(indent) + result + name + "\n" + blanks(indent + 4) + too_long.text + "\n";
}

namespace {

std::string laid_out(std::size_t indent, const std::string& head, const Items& arguments,
                     const std::string& tail, const Prices& prices) {
  std::optional<Way> best;
  consider_both(best, indent, "", head, arguments, tail, prices);
  if (best) return best->text;
  const Packed too_long = pack(indent + 4, indent + 4, arguments, ",", tail);
  return blanks(indent) + head + "\n" + blanks(indent + 4) + too_long.text + "\n";
}

}  // namespace

std::string call(std::size_t indent, const std::string& head, const Items& arguments,
                 const std::string& tail) {
  return laid_out(indent, head, arguments, tail, kCall);
}

std::string macro(const std::string& head, const Items& arguments, const std::string& tail) {
  return laid_out(0, head, arguments, tail, kDeclaration);
}

std::string call_with_call(std::size_t indent, const Call& outer, const Call& inner,
                           const std::string& tail) {
  std::string whole = inner.head;
  for (const std::string& each : inner.arguments) {
    whole += (&each == &inner.arguments.front() ? "" : ", ") + each;
  }
  Items arguments = outer.arguments;
  arguments.push_back(whole);
  std::string head = outer.head;
  for (const std::string& each : outer.arguments) head += each + ", ";
  std::optional<Way> best;
  consider_both(best, indent, "", outer.head, arguments, tail, kCall);
  const std::size_t inside = indent + base::columns_of(head + inner.head);
  const Packed aligned = pack(inside, inside, inner.arguments, ",", tail);
  consider(best, aligned, blanks(indent) + head + inner.head,
           kFirstBreak + aligned.breaks * kDeeper.each);
  if (best) return best->text;
  // Both are divided: the inner one on a line of its own, if need be the outer arguments below.
  const std::size_t column = indent + base::columns_of(outer.head);
  for (const std::size_t begin : {column, indent + 4}) {
    const std::size_t inner_column = begin + base::columns_of(inner.head);
    const Packed parts = pack(inner_column, inner_column, inner.arguments, ",", tail);
    std::string text = blanks(indent) + outer.head + (begin == column ? "" : "\n" + blanks(begin));
    for (const std::string& each : outer.arguments) text += each + ",\n" + blanks(begin);
    consider(best, parts, text + inner.head, parts.breaks * kDeeper.each);
  }
  if (best) return best->text;
  return call(indent, outer.head, arguments, tail);
}

std::string nested_call(std::size_t indent, const std::string& outer, const std::string& inner,
                        const Items& arguments, const std::string& tail) {
  std::optional<Way> best;
  consider_both(best, indent, "", outer + inner, arguments, tail, kDeeper);
  consider_both(best, indent + 4, blanks(indent) + outer + "\n", inner, arguments, tail,
                {kFirstBreak + kBehindOnlyArgument, kDeeper.each, kDeeper.behind_parenthesis});
  return best ? best->text : call(indent, outer + inner, arguments, tail);
}

std::string chain(std::size_t indent, const std::string& head, const Items& operands,
                  std::string_view operation, const std::string& tail) {
  const std::size_t column = indent + base::columns_of(head);
  const std::string separator = " " + std::string(operation);
  return blanks(indent) + head + pack(column, column, operands, separator, tail).text + "\n";
}

std::string short_function(std::size_t indent, const Function& head, const std::string& statement) {
  std::string line = blanks(indent) + head.result + " " + head.name + "(";
  for (const std::string& each : head.parameters) {
    line += (&each == &head.parameters.front() ? "" : ", ") + each;
  }
  line += ") { " + statement + " }";
  if (base::columns_of(line) <= kColumns) return line + "\n";
  return function(indent, head) + blanks(indent + 2) + statement + "\n" + blanks(indent) + "}\n";
}

std::string class_head(const std::string& name, const std::string& base) {
  const std::string line = "class " + name + " : public " + base + " {";
  if (base::columns_of(line) <= kColumns) return line + "\n";
  return "class " + name + "\n    : public " + base + " {\n";
}

namespace {

/// A backslash at the end would take the next line into the comment.
std::string_view without_continuation(std::string_view line) {
  while (!line.empty() && (line.back() == '\\' || line.back() == ' ' || line.back() == '\t')) {
    line.remove_suffix(1);
  }
  return line.ends_with("?\?/") ? line.substr(0, line.size() - 3) : line;
}

void add_comment_line(std::string& text, std::size_t indent, std::string_view line) {
  text += blanks(indent) + "///";
  if (!line.empty()) text += " " + std::string(without_continuation(line));
  text += "\n";
}

/// The first part of `line` that fits, up to a blank, and what follows it.
std::string_view take_fitting(std::string_view& line, std::size_t room) {
  std::size_t end = line.size();
  while (end > room) {
    const std::size_t blank = line.rfind(' ', end - 1);
    if (blank == std::string_view::npos || blank == 0) break;
    end = blank;
  }
  if (end > room) end = std::min(line.find(' '), line.size());
  const std::string_view part = line.substr(0, end);
  line.remove_prefix(end);
  while (line.starts_with(' ')) line.remove_prefix(1);
  return part;
}

}  // namespace

std::string comment(std::size_t indent, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& each : lines) {
    std::string blank_free = each;
    std::replace(blank_free.begin(), blank_free.end(), '\t', ' ');
    std::string_view rest = without_continuation(blank_free);
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    do {
      add_comment_line(text, indent, take_fitting(rest, kColumns - indent - 4));
    } while (!rest.empty());
  }
  return text;
}

std::string hexadecimal(std::uint32_t number) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08x", number);
  return text;
}

std::string literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::string long_literal(std::size_t indent, std::string_view text) {
  const std::size_t room = kColumns - indent - 4;
  std::string result;
  while (text.size() > room) {
    result += literal(text.substr(0, room)) + "\n" + blanks(indent);
    text.remove_prefix(room);
  }
  return result + literal(text);
}

}  // namespace armature::idl::internal
