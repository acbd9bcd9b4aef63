// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/robot.hpp"

#include <algorithm>

#include "armature/base/near_name.hpp"
#include "armature/browser/internal/words.hpp"

namespace armature::browser::internal {
namespace {

std::string hint(std::string_view name, const std::vector<std::string>& known) {
  const std::string text = base::suggestion(name, known);
  return text.empty() ? text : " (" + text + ")";
}

std::vector<std::string> member_names(const remote::ComponentDetails& component) {
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

std::string no_component(Robot& robot, std::string_view text) {
  return "unknown component '" + std::string(text) + "'" + hint(text, robot.component_names());
}

base::Result<MemberName> member_in(Robot& robot, std::string_view text) {
  MemberName found;
  std::size_t size = text.size();
  while (size > 0) {
    size = text.find_last_of(".:", size - 1);
    if (size == std::string_view::npos || size == 0) {
      return base::Error{no_component(robot, text.substr(0, text.find_first_of(".:[")))};
    }
    found.component = robot.find(text.substr(0, size));
    if (!found.component.empty()) break;
  }
  found.separator = text[size];
  const std::string_view behind = text.substr(size + 1);
  const auto end = std::find_if_not(behind.begin(), behind.end(), is_name_character);
  found.member.assign(behind.begin(), end);
  found.rest.assign(end, behind.end());
  const std::vector<std::string> names = member_names(robot.interface_of(found.component));
  if (std::find(names.begin(), names.end(), found.member) != names.end()) return found;
  return base::Error{"'" + found.component + "' has no '" + found.member + "'" +
                     hint(found.member, names)};
}

}  // namespace armature::browser::internal
