// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "armature/base/quoted.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

using base::quoted;

/// Finds components and their ports by name in constant time, however many there are.
class Directory {
 public:
  /// Reports names that are taken twice.
  Directory(const Blueprint& blueprint, base::Diagnostics& diagnostics);

  Index component(std::string_view name) const;
  /// A port and its number among all of the blueprint; nullptr if there is none of this name.
  struct Input {
    component::InputPortBase* port = nullptr;
    Index number = kNone;
  };
  Input input(Index component, std::string_view name) const;
  /// The number of the component's first input; the others follow in their order.
  Index first_input(Index component) const { return ports_[component].first_input; }
  std::size_t input_count() const { return input_count_; }
  component::OutputPortBase* output(Index component, std::string_view name) const;

  std::vector<std::string> component_names() const;
  std::vector<std::string> input_names(Index component) const;
  std::vector<std::string> output_names(Index component) const;

 private:
  /// Where among its component's ports a name stands.
  using Places = std::unordered_map<std::string_view, Index>;
  struct Ports {
    Index first_input = 0;
    Places inputs;
    Places outputs;
  };
  const Blueprint& blueprint_;
  std::unordered_map<std::string_view, Index> components_;
  std::vector<Ports> ports_;
  std::size_t input_count_ = 0;
};

}  // namespace armature::exec::internal
