// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/lua_language.hpp"

#include <optional>
#include <utility>

#include "armature/base/unit.hpp"
#include "armature/browser/internal/words.hpp"
#include "armature/inspect/items.hpp"
#include "armature/lua/names.hpp"

namespace armature::browser::internal {

using inspect::Item;
using inspect::Member;

/// An assignment whose target may be an item.
struct LuaLanguage::ItemAssignment : Assignment {
  using Assignment::Assignment;
  std::optional<Item> item;
};

std::string LuaLanguage::plain(std::string_view text) const { return lua::without_lua(text); }

std::string LuaLanguage::spelled(const std::string& component) const {
  return lua::in_lua(component);
}

bool LuaLanguage::goes_on(std::string_view behind) const {
  return !behind.empty() &&
         std::string_view("=([.:+*/%<>~^,;").find(behind.front()) != std::string_view::npos;
}

/// With what Lua needs for the component that it begins with, if that has a
/// name which Lua would misread; `_G["aic-1"].Gain` for `aic-1.Gain`.
std::string LuaLanguage::line_in_lua(std::string_view text) const {
  const component::Component* const component =
      inspect::leading_component(application_, text, ".:[ =");
  if (component == nullptr) return std::string(text);
  return lua::in_lua(component->name()) + std::string(text.substr(component->name().size()));
}

/// What Lua would take without a word, or not at all: a part of a copy, a value
/// with its unit.
bool LuaLanguage::prepare(ItemAssignment& assignment) {
  const base::Result<Item> item = inspect::find_item(application_, plain(assignment.target));
  if (!item) return true;
  assignment.item = item.value();
  const Member& member = item.value().member;
  if (!item.value().parts.empty() && member.property != nullptr) {
    answers_.mistake("'" + assignment.target + "' is a part of what was read: set the whole, " +
                     member.name() + " = ...");
    return false;
  }
  const auto quantity = base::parse_quantity(assignment.value);
  if (!quantity || quantity.value().unit.empty()) return true;
  const auto number = base::convert(quantity.value().value, quantity.value().unit, member.unit());
  if (!number) {
    answers_.mistake(member.name() + ": " + number.error());
    return false;
  }
  assignment.value = number_text("%.17g", number.value());
  return true;
}

void LuaLanguage::take(std::string_view line) {
  const std::string text = wants_more() ? lines_ + "\n" + std::string(line) : std::string(line);
  lines_.clear();
  ItemAssignment assignment(text);
  std::string lua = line_in_lua(text);
  if (!assignment.target.empty()) {
    if (!prepare(assignment)) return;
    if (assignment.item) lua = line_in_lua(assignment.target) + " = " + assignment.value;
  }
  if (interpreter_.is_incomplete(lua)) {
    lines_ = text;
  } else if (!interpreter_.run(lua)) {
    answers_.count_mistake();
  } else if (assignment.item) {
    show(assignment);
  }
}

/// What the item is now.
void LuaLanguage::show(const ItemAssignment& assignment) {
  const inspect::ItemValue now = view_.read({assignment.item->text}, kAskedElements).front();
  if (now.error.empty()) answers_.say(now.item + " = " + with_unit(now.value, now.unit));
}

}  // namespace armature::browser::internal
