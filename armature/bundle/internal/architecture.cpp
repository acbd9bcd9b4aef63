// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/architecture.hpp"

#include <algorithm>

namespace armature::bundle::internal {
namespace {

template <typename Condition>
const Architecture* first(Condition condition) {
  const auto* const found = std::ranges::find_if(kArchitectures, condition);
  return found == kArchitectures.end() ? nullptr : found;
}

}  // namespace

const Architecture* find_architecture(std::string_view name) {
  return first([name](const Architecture& each) { return each.name == name; });
}

const Architecture* architecture_of(const platform::LinkedFile& file) {
  return first([&file](const Architecture& each) {
    return each.machine == file.machine && each.bits == file.bits;
  });
}

std::string machine_name(const platform::LinkedFile& file) {
  const Architecture* const found = architecture_of(file);
  if (found != nullptr) return std::string(found->name);
  return "machine " + std::to_string(file.machine) + " with " + std::to_string(file.bits) + " bits";
}

}  // namespace armature::bundle::internal
