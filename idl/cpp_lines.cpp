// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/cpp_lines.hpp"

#include <algorithm>
#include <cstdio>

#include "armature/base/utf8.hpp"

namespace armature::idl::internal {
namespace {

constexpr std::size_t kStep = 4;
constexpr std::size_t kQuotes = 2;
constexpr std::size_t kClosing = 3;  ///< what may stand behind an item: `));`

std::string blanks(std::size_t count) { return std::string(count, ' '); }

std::string line(std::size_t indent, const std::string& text) {
  return blanks(indent) + text + "\n";
}

/// What is divided already fits nowhere.
bool fits(std::size_t indent, const std::string& text, std::size_t columns = kColumns) {
  return text.find('\n') == std::string::npos && indent + base::columns_of(text) <= columns;
}

std::string joined(const Items& items, const std::string& separator) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "" : separator) + items[i];
  return text;
}

std::string in_columns(std::size_t columns, std::size_t indent, const std::string& head,
                       const Items& items, const std::string& tail) {
  const std::string whole = head + joined(items, ", ") + tail;
  if (items.empty() || fits(indent, whole, columns)) return whole;
  const std::string begin = "\n" + blanks(indent + kStep);
  return head + begin + joined(items, "," + begin) + tail;
}

}  // namespace

std::string list(std::size_t indent, const std::string& head, const Items& items,
                 const std::string& tail) {
  return line(indent, in_columns(kColumns, indent, head, items, tail));
}

std::string item(std::size_t indent, const std::string& head, const Items& items,
                 const std::string& tail) {
  return in_columns(kColumns - kClosing, indent, head, items, tail);
}

std::string call_with_call(std::size_t indent, const Call& outer, const Call& inner,
                           const std::string& tail) {
  Items all = outer.arguments;
  all.push_back(inner.head + joined(inner.arguments, ", "));
  const std::string whole = outer.head + joined(all, ", ") + tail;
  if (fits(indent, whole)) return line(indent, whole);
  std::string text = line(indent, outer.head);
  for (const std::string& each : outer.arguments) text += line(indent + kStep, each + ",");
  return text + list(indent + kStep, inner.head, inner.arguments, tail);
}

std::string chain(std::size_t indent, const std::string& head, const Items& items,
                  const std::string& operation, const std::string& tail) {
  const std::string whole = head + joined(items, " " + operation + " ") + tail;
  if (fits(indent, whole)) return line(indent, whole);
  const std::string separator = " " + operation + "\n" + blanks(indent + kStep);
  return line(indent, head + joined(items, separator) + tail);
}

std::string declaration(std::size_t indent, const std::string& type, const std::string& name) {
  const std::string whole = type + " " + name;
  if (fits(indent, whole)) return line(indent, whole);
  return line(indent, type) + line(indent + kStep, name);
}

std::string list_of(std::size_t indent, const std::string& type, const std::string& head,
                    const Items& items, const std::string& tail) {
  const std::string whole = type + " " + head;
  const bool together = fits(indent, whole + (items.empty() ? tail : ""));
  if (together) return list(indent, whole, items, tail);
  return line(indent, type) + list(indent, head, items, tail);
}

std::string declared(std::size_t indent, const Function& function, const std::string& tail) {
  return list_of(indent, function.result, function.name + "(", function.parameters, ")" + tail);
}

std::string defined(std::size_t indent, const Function& function, const std::string& body) {
  return declared(indent, function, " {") + body + line(indent, "}");
}

namespace {

/// Greedy lines of at most `columns`, each divided behind the character `behind`.
Items divided(std::string_view text, std::size_t columns, char behind) {
  Items lines(1);
  while (!text.empty()) {
    const std::string part(text.substr(0, text.find(behind)));
    const std::string whole = part + (part.size() < text.size() ? std::string(1, behind) : "");
    const bool full = base::columns_of(lines.back() + whole) > columns;
    if (full && !lines.back().empty()) lines.emplace_back();
    lines.back() += whole;
    text.remove_prefix(whole.size());
  }
  return lines;
}

/// A backslash at the end would take the next line into the comment.
std::string_view without_continuation(std::string_view line) {
  while (!line.empty() && (line.back() == '\\' || line.back() == ' ')) line.remove_suffix(1);
  return line.ends_with("?\?/") ? line.substr(0, line.size() - 3) : line;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

}  // namespace

std::string comment(std::size_t indent, const std::vector<std::string>& lines) {
  std::string text;
  for (std::string each : lines) {
    std::replace(each.begin(), each.end(), '\t', ' ');
    each.erase(0, std::min(each.find_first_not_of(' '), each.size()));
    for (const std::string& part : divided(each, kColumns - indent - 4, ' ')) {
      const std::string_view words = without_continuation(part);
      text += line(indent, words.empty() ? "///" : "/// " + std::string(words));
    }
  }
  return text;
}

std::string hexadecimal(std::uint32_t number) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08x", number);
  return text;
}

std::string literal(std::string_view text) { return "\"" + escaped(text) + "\""; }

std::string long_literal(std::size_t indent, std::string_view text, char behind) {
  Items parts = divided(escaped(text), kColumns - indent - kQuotes - kClosing, behind);
  for (std::string& part : parts) part = "\"" + part + "\"";
  return joined(parts, "\n" + blanks(indent));
}

}  // namespace armature::idl::internal
