// SPDX-License-Identifier: Apache-2.0
#include "armature/component/registry.hpp"

#include <algorithm>
#include <utility>

namespace armature::component {
namespace {

std::string origin(const std::string& library) {
  return library.empty() ? "the program" : "library '" + library + "'";
}

/// What stands in `name` where `pattern` has its `#`: a number above 0; empty if it does not fit.
std::string number_at(std::string_view pattern, std::string_view name) {
  const std::size_t mark = pattern.find('#');
  if (mark == std::string_view::npos || name.size() < pattern.size()) return {};
  const std::string_view number = name.substr(mark, name.size() - pattern.size() + 1);
  const bool fits = name.starts_with(pattern.substr(0, mark)) &&
                    name.ends_with(pattern.substr(mark + 1)) && number.front() != '0' &&
                    std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
  return fits ? std::string(number) : std::string();
}

}  // namespace

base::Result<void> Registry::add(Model model) {
  const auto taken = [&](std::string_view name) -> const Model* {
    const auto known = models_.find(name);
    if (known != models_.end()) return &known->second;
    for (const auto& [other, each] : models_) {
      for (const FurtherName& further : each.further_names) {
        if (further.name == name) return &each;
      }
    }
    return nullptr;
  };
  std::vector<std::string> names = {model.name};
  for (const FurtherName& further : model.further_names) names.push_back(further.name);
  for (const std::string& name : names) {
    if (const Model* const known = taken(name)) {
      return base::Error{"model '" + name + "' of " + origin(model.library) +
                         " exists already, in " + origin(known->library)};
    }
  }
  models_.emplace(names.front(), std::move(model));
  return {};
}

std::string Registry::add_here(Model model) {
  const base::Result<void> added = add(std::move(model));
  return added ? std::string() : added.error() + "; ";
}

std::string Registry::end_library() {
  library_.clear();
  std::string problems = std::exchange(problems_, {});
  if (!problems.empty()) problems.resize(problems.size() - 2);
  return problems;
}

const Registry::Model* Registry::find(std::string_view name) const {
  const auto found = models_.find(name);
  if (found != models_.end()) return &found->second;
  const std::optional<Further> further = find_further(name);
  return further ? further->model : nullptr;
}

std::optional<Registry::NumberInName> Registry::number_in(std::string_view name) const {
  if (models_.contains(name)) return std::nullopt;
  const std::optional<Further> further = find_further(name);
  if (!further || further->number.empty()) return std::nullopt;
  return NumberInName{further->name->property, further->number};
}

std::optional<Registry::Further> Registry::find_further(std::string_view name) const {
  for (const auto& [ignored, model] : models_) {
    for (const FurtherName& each : model.further_names) {
      if (each.name == name) return Further{&model, &each, {}};
      std::string number = number_at(each.name, name);
      if (!number.empty()) return Further{&model, &each, std::move(number)};
    }
  }
  return std::nullopt;
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> names;
  for (const auto& [name, model] : models_) names.push_back(name);
  return names;
}

const char* abi_tag() { return ARMATURE_ABI_TAG; }

std::uint64_t runtime_layout() { return layout_fingerprint(); }

}  // namespace armature::component
