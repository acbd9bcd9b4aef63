// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/items.hpp"

#include "armature/lua/names.hpp"

namespace armature::browser::internal {

std::string spelled_for_lua(const exec::Application& application, std::string_view text) {
  const component::Component* const component =
      inspect::leading_component(application, text, ".:[ =");
  if (component == nullptr) return std::string(text);
  return lua::in_lua(component->name()) + std::string(text.substr(component->name().size()));
}

component::Component* find_component(const exec::Application& application, std::string_view text) {
  return application.find(lua::without_lua(text));
}

base::Result<Member> find_member(const exec::Application& application, std::string_view text) {
  return inspect::find_member(application, lua::without_lua(text));
}

base::Result<Item> find_item(const exec::Application& application, std::string_view text) {
  return inspect::find_item(application, lua::without_lua(text));
}

}  // namespace armature::browser::internal
