// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/names.hpp"

#include <algorithm>
#include <cctype>

namespace armature::lua {
namespace {

constexpr std::string_view kReserved[] = {"and",   "break", "do",       "else", "elseif", "end",
                                          "false", "for",   "function", "goto", "if",     "in",
                                          "local", "nil",   "not",      "or",   "repeat", "return",
                                          "then",  "true",  "until",    "while"};

bool may_begin_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool may_be_in_name(char c) {
  return may_begin_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool is_lua_name(std::string_view text) {
  return !text.empty() && may_begin_name(text.front()) &&
         std::all_of(text.begin(), text.end(), may_be_in_name) &&
         std::find(std::begin(kReserved), std::end(kReserved), text) == std::end(kReserved);
}

}  // namespace

std::string in_lua(std::string_view component) {
  std::string text;
  while (true) {
    const std::size_t dot = std::min(component.find('.'), component.size());
    const std::string part(component.substr(0, dot));
    if (is_lua_name(part)) {
      text += (text.empty() ? "" : ".") + part;
    } else {
      text += (text.empty() ? "_G[\"" : "[\"") + part + "\"]";
    }
    if (dot == component.size()) return text;
    component.remove_prefix(dot + 1);
  }
}

std::string without_lua(std::string_view text) {
  constexpr std::string_view kBegin = "_G[\"";
  const bool indexed = text.starts_with(kBegin);
  if (!indexed && !text.starts_with('"')) return std::string(text);
  text.remove_prefix(indexed ? kBegin.size() : 1);
  const std::string_view end = indexed ? "\"]" : "\"";
  const std::size_t at = text.find(end);
  if (at == std::string_view::npos) return std::string(text);
  return std::string(text.substr(0, at)) + std::string(text.substr(at + end.size()));
}

}  // namespace armature::lua
