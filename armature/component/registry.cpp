// SPDX-License-Identifier: Apache-2.0
#include "armature/component/registry.hpp"

#include <utility>

namespace armature::component {
namespace {

std::string origin(const std::string& library) {
  return library.empty() ? "the program" : "library '" + library + "'";
}

}  // namespace

base::Result<void> Registry::add(Model model) {
  const auto known = models_.find(model.name);
  if (known != models_.end()) {
    return base::Error{"model '" + model.name + "' of " + origin(model.library) +
                       " exists already, in " + origin(known->second.library)};
  }
  std::string name = model.name;
  models_.emplace(std::move(name), std::move(model));
  return {};
}

std::string Registry::add_here(std::string_view name, std::string_view doc, Make make) {
  const base::Result<void> added = add(Model{std::string(name), std::string(doc), library_, make});
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
  return found == models_.end() ? nullptr : &found->second;
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> names;
  for (const auto& [name, model] : models_) names.push_back(name);
  return names;
}

const char* abi_tag() { return ARMATURE_ABI_TAG; }

std::uint64_t runtime_layout() { return layout_fingerprint(); }

}  // namespace armature::component
