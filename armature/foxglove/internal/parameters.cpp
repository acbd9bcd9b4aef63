// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/parameters.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/foxglove/internal/flow_json.hpp"

namespace armature::foxglove::internal {
namespace {

/// Of one request: fewer than an inspector takes.
constexpr std::size_t kAtOnce = 200;

}  // namespace

void Parameters::replace(const std::vector<inspect::ComponentDescription>& components) {
  known_.clear();
  for (const auto& component : components) {
    for (const auto& property : component.properties) {
      known_[component.name + "." + property.name] = {shape_of(property.type, component.fields),
                                                      property.by_operator};
    }
  }
  for (auto& [name, value] : told_) value.reset();
}

/// Those of `names` that there are; all if it is empty.
std::vector<std::string> Parameters::named(const std::vector<std::string>& names) const {
  std::vector<std::string> found;
  for (const auto& [name, known] : known_) {
    if (names.empty() || std::ranges::count(names, name) > 0) found.push_back(name);
  }
  return found;
}

std::vector<Parameter> Parameters::read(const std::vector<std::string>& names) {
  std::vector<Parameter> parameters;
  for (std::size_t begin = 0; begin < names.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, names.size());
    for (const auto& one : view_.read({names.begin() + static_cast<std::ptrdiff_t>(begin),
                                       names.begin() + static_cast<std::ptrdiff_t>(end)})) {
      const auto known = known_.find(one.item);
      if (!one.error.empty() || known == known_.end()) continue;
      parameters.push_back({one.item, json_of_text(known->second.shape, one.value)});
    }
  }
  return parameters;
}

void Parameters::get(const GetParameters& request) {
  outlet_.tell(parameter_values(read(named(request.names)), request.id));
}

void Parameters::set(const SetParameters& request) {
  std::vector<std::string> names;
  for (const Parameter& one : request.parameters) {
    names.push_back(one.name);
    const auto done = set(one);
    if (!done) {
      outlet_.tell(
          status(Level::kError, base::quoted(one.name) + " is left as it is: " + done.error()));
    }
  }
  const auto found = names.empty() ? names : named(names);
  if (request.id) outlet_.tell(parameter_values(read(found), request.id));
}

base::Result<void> Parameters::set(const Parameter& parameter) {
  const auto known = known_.find(parameter.name);
  if (known == known_.end()) return base::Error{"there is no such property"};
  if (known->second.by_operator) {
    return base::Error{"it is a word of the operator, which is not said by Foxglove"};
  }
  const auto text = text_of_json(parameter.value);
  if (!text) return base::Error{text.error()};
  try {
    view_.write(parameter.name, text.value());
  } catch (const inspect::NoAnswer& refusal) {
    return base::Error{refusal.what()};
  }
  return {};
}

void Parameters::subscribe(const SubscribeParameters& request) {
  if (request.names.empty()) told_of_all_ = true;
  for (const std::string& name : request.names) {
    if (known_.contains(name)) told_.try_emplace(name);
  }
}

void Parameters::unsubscribe(const UnsubscribeParameters& request) {
  if (request.names.empty()) told_.clear();
  if (request.names.empty()) told_of_all_ = false;
  for (const std::string& name : request.names) told_.erase(name);
}

void Parameters::look() {
  if (told_of_all_) {
    for (const auto& [name, known] : known_) told_.try_emplace(name);
  }
  std::vector<std::string> names;
  for (const auto& [name, value] : told_) {
    if (known_.contains(name)) names.push_back(name);
  }
  if (names.empty()) return;
  std::vector<Parameter> changed = read(names);
  std::erase_if(changed, [this](const Parameter& one) {
    std::optional<Json>& before = told_[one.name];
    if (before == one.value) return true;
    before = one.value;
    return false;
  });
  if (!changed.empty()) outlet_.tell(parameter_values(changed, std::nullopt));
}

}  // namespace armature::foxglove::internal
