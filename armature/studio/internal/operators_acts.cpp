// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/operators_acts.hpp"

namespace armature::studio::internal {
namespace {

template <typename Members>
Act act_of(const Members& members, std::string_view name) {
  const auto found = members.find(name);
  if (found == members.end()) return Act::kUnknown;
  return found->second ? Act::kOperators : Act::kAnybodys;
}

}  // namespace

void OperatorsActs::expect(const std::vector<remote::ComponentStatus>& components) {
  expected_ = true;
  for (const remote::ComponentStatus& one : components) {
    if (!components_.contains(one.name)) missing_.insert(one.name);
  }
}

void OperatorsActs::add(const remote::ComponentDetails& details) {
  Members& members = components_[details.status.name];
  for (const auto& one : details.operations) members.operations[one.name] = one.by_operator;
  for (const auto& one : details.properties) members.properties[one.name] = one.by_operator;
  missing_.erase(details.status.name);
}

std::vector<std::string> OperatorsActs::missing() const {
  return {missing_.begin(), missing_.end()};
}

Act OperatorsActs::of_operation(const std::string& component, const std::string& operation) const {
  const auto found = components_.find(component);
  return found == components_.end() ? Act::kUnknown : act_of(found->second.operations, operation);
}

/// The longest name with which it begins is the component's, as the run reads it.
Act OperatorsActs::of_item(std::string_view item) const {
  for (std::size_t size = item.size(); size > 0; --size) {
    if (size < item.size() && item[size] != '.') continue;
    const auto found = components_.find(item.substr(0, size));
    if (found == components_.end()) continue;
    if (size == item.size()) return Act::kUnknown;
    const std::string_view member = item.substr(size + 1);
    return act_of(found->second.properties, member.substr(0, member.find_first_of(".[:")));
  }
  return Act::kUnknown;
}

std::vector<std::string> OperatorsActs::disarmed() const {
  std::vector<std::string> names;
  for (const auto& [name, members] : components_) {
    const bool armed = act_of(members.operations, "arm") == Act::kOperators;
    if (armed && members.operations.contains("disarm")) names.push_back(name);
  }
  return names;
}

}  // namespace armature::studio::internal
