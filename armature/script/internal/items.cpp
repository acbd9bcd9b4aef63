// SPDX-License-Identifier: Apache-2.0
#include "armature/script/internal/items.hpp"

#include <algorithm>

#include "armature/script/internal/words.hpp"

namespace armature::script::internal {
namespace {

constexpr std::string_view kReserved[] = {"and",   "break", "do",       "else", "elseif", "end",
                                          "false", "for",   "function", "goto", "if",     "in",
                                          "local", "nil",   "not",      "or",   "repeat", "return",
                                          "then",  "true",  "until",    "while"};

}  // namespace

bool is_lua_name(std::string_view text) {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), is_name_character) &&
         std::find(std::begin(kReserved), std::end(kReserved), text) == std::end(kReserved);
}

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

std::string spelled_for_lua(const exec::Application& application, std::string_view text) {
  const component::Component* const component =
      inspect::leading_component(application, text, ".:[ =");
  if (component == nullptr) return std::string(text);
  return in_lua(component->name()) + std::string(text.substr(component->name().size()));
}

component::Component* find_component(const exec::Application& application, std::string_view text) {
  return application.find(without_lua(text));
}

base::Result<Member> find_member(const exec::Application& application, std::string_view text) {
  return inspect::find_member(application, without_lua(text));
}

base::Result<Item> find_item(const exec::Application& application, std::string_view text) {
  return inspect::find_item(application, without_lua(text));
}

}  // namespace armature::script::internal
