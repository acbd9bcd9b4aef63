// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/spelled_view.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/browser/internal/display.hpp"
#include "armature/browser/internal/plain_values.hpp"
#include "armature/browser/internal/words.hpp"

namespace armature::browser::internal {
namespace {

using inspect::ComponentDescription;
using inspect::ItemValue;

std::vector<std::string> member_names(const ComponentDescription& component) {
  std::vector<std::string> names;
  const auto add = [&](const auto& members) {
    for (const auto& one : members) names.push_back(one.name);
  };
  add(component.properties);
  add(component.inputs);
  add(component.outputs);
  add(component.operations);
  add(component.events);
  return names;
}

}  // namespace

std::string state_name(const inspect::ComponentStatus& component) {
  return component.state ? std::string(component::name_of(*component.state)) : std::string();
}

std::string SpelledView::find(std::string_view text) {
  const std::string name = language_.plain(text);
  const std::vector<std::string> names = component_names();
  return std::ranges::find(names, name) == names.end() ? std::string() : name;
}

std::string SpelledView::no_component(std::string_view text) {
  return "unknown component '" + std::string(text) + "'" +
         base::suggestion_in_brackets(text, component_names());
}

base::Result<MemberName> SpelledView::member_in(std::string_view text) {
  MemberName found;
  std::size_t size = text.size();
  while (size > 0) {
    size = text.find_last_of(".:", size - 1);
    if (size == std::string_view::npos || size == 0) {
      return base::Error{no_component(text.substr(0, text.find_first_of(".:[")))};
    }
    found.component = find(text.substr(0, size));
    if (!found.component.empty()) break;
  }
  found.separator = text[size];
  const std::string_view behind = text.substr(size + 1);
  const auto end = std::find_if_not(behind.begin(), behind.end(), is_name_character);
  found.member.assign(behind.begin(), end);
  found.rest.assign(end, behind.end());
  const std::vector<std::string> names = member_names(interface_of(found.component));
  if (std::find(names.begin(), names.end(), found.member) != names.end()) return found;
  return base::Error{"'" + found.component + "' has no '" + found.member + "'" +
                     base::suggestion_in_brackets(found.member, names)};
}

ComponentDescription SpelledView::look_at(const std::string& component) {
  ComponentDescription description = view_.describe(component, inspect::Values::kIncluded);
  const auto shorten = [&](auto& members) {
    for (auto& one : members) {
      one.value = internal::for_people(one.value, one.type, description.fields, kUsualElements);
    }
  };
  shorten(description.properties);
  shorten(description.inputs);
  shorten(description.outputs);
  return description;
}

ItemValue SpelledView::for_people(ItemValue value, std::size_t most_elements) {
  std::vector<inspect::FieldDescription> fields;
  const bool has_structs = value.value.find('{') != std::string::npos;
  const auto member = has_structs ? member_in(value.item) : base::Error{""};
  if (member) fields = interface_of(member.value().component).fields;
  value.value = internal::for_people(value.value, value.type, fields, most_elements);
  return value;
}

std::vector<ItemValue> SpelledView::read(const std::vector<std::string>& items,
                                         std::size_t most_elements) {
  std::vector<std::string> plain;
  for (const std::string& item : items) plain.push_back(language_.plain(item));
  std::vector<ItemValue> values = view_.read(plain);
  for (ItemValue& one : values) one = for_people(std::move(one), most_elements);
  return values;
}

ItemValue SpelledView::write(const std::string& item, const std::string& value) {
  return for_people(view_.write(item, value), kAskedElements);
}

std::string SpelledView::call(const std::string& component, const std::string& operation,
                              const std::vector<std::string>& arguments) {
  const inspect::CallResult result = view_.call(component, operation, arguments);
  if (!result.given) return {};
  return internal::for_people(result.value, result.type, {}, kAskedElements);
}

SpelledView::Changed SpelledView::change(const std::string& component,
                                         inspect::LifeCycleChange change) {
  try {
    return {{}, state_name(view_.change(component, change))};
  } catch (const inspect::Refusal& refusal) {
    const auto it = view_.components([&](const std::string& name) { return name == component; });
    return {refusal.what(), it.empty() ? std::string() : state_name(it.front())};
  }
}

}  // namespace armature::browser::internal
