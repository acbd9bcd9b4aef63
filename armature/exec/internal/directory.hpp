// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// Finds components and their ports by name in constant time, however many there are.
class Directory {
 public:
  /// Reports names that are taken twice.
  Directory(const Blueprint& blueprint, base::Diagnostics& diagnostics);

  Index component(std::string_view name) const;
  component::InputPortBase* input(Index component, std::string_view name) const;
  component::OutputPortBase* output(Index component, std::string_view name) const;

  std::vector<std::string> component_names() const;
  std::vector<std::string> input_names(Index component) const;
  std::vector<std::string> output_names(Index component) const;

 private:
  struct Ports {
    std::unordered_map<std::string_view, component::InputPortBase*> inputs;
    std::unordered_map<std::string_view, component::OutputPortBase*> outputs;
  };
  const Blueprint& blueprint_;
  std::unordered_map<std::string_view, Index> components_;
  std::vector<Ports> ports_;
};

/// `'Name'`, for messages.
std::string quoted(std::string_view name);

}  // namespace armature::exec::internal
