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

bool LuaLanguage::goes_on(std::string_view behind) const {
  return !behind.empty() &&
         std::string_view("=([.:+*/%<>~^,;").find(behind.front()) != std::string_view::npos;
}

/// With what Lua needs for the component that it begins with, if that has a
/// name which Lua would misread; `_G["aic-1"].Gain` for `aic-1.Gain`.
std::string LuaLanguage::spelled(std::string_view text) const {
  const component::Component* const component =
      inspect::leading_component(application_, text, ".:[ =");
  if (component == nullptr) return std::string(text);
  return lua::in_lua(component->name()) + std::string(text.substr(component->name().size()));
}

/// What Lua would take without a word, or not at all: a part of a copy, a value
/// with its unit.
bool LuaLanguage::prepare(ItemAssignment& assignment) {
  const base::Result<Item> item =
      inspect::find_item(application_, lua::without_lua(assignment.target));
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
  std::string lua = spelled(text);
  if (!assignment.target.empty()) {
    if (!prepare(assignment)) return;
    if (assignment.item) lua = spelled(assignment.target) + " = " + assignment.value;
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
  const Item& item = *assignment.item;
  const auto readings = inspect::read_members(application_, {item.member});
  if (!readings) return;
  answers_.say(item.text + " = " +
               value_text(*item.type, readings->front().whole.data(), item.unit, kAskedElements));
}

}  // namespace armature::browser::internal
