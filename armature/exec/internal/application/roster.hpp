// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// The components of an application by name, while it exists.
class Roster {
 public:
  explicit Roster(const Blueprint& blueprint);

  const Blueprint& blueprint() const { return blueprint_; }
  /// nullptr if there is none of this name.
  component::Component* find(std::string_view name) const;
  Index index_of(const component::Component& component) const;
  const ComponentEntry& entry_of(const component::Component& component) const;
  /// That there is none of this name, and which one may be meant.
  std::string unknown(std::string_view name) const;

 private:
  const Blueprint& blueprint_;
  std::unordered_map<std::string_view, Index> index_of_;
};

}  // namespace armature::exec::internal
