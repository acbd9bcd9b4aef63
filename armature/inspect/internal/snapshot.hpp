// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/author.hpp"
#include "armature/inspect/describe.hpp"
#include "armature/inspect/items.hpp"

namespace armature::inspect::internal {

/// What changes in a component as it works, at one moment: each list in the order of the interface.
class Snapshot {
 public:
  /// What callers of operations and handlers of events need.
  struct Requirement {
    bool wanted = true;
    std::string peer;
    std::uint64_t not_taken = 0;
  };

  /// Has room for all of it.
  /// @param component  outlives it
  /// @thread any
  explicit Snapshot(const component::Component& component);

  /// Copies it.
  /// @param now  by which the ages of values are
  /// @thread the component's own, or any while the component does not run
  void take(base::Time now);

  std::vector<Reading> properties;
  std::vector<Reading> inputs;
  std::vector<Reading> outputs;
  std::vector<component::InputCounters> input_counters;
  std::vector<component::OutputCounters> output_counters;
  std::vector<std::uint64_t> raised;
  std::vector<Requirement> callers;
  std::vector<Requirement> handlers;
  std::vector<std::string_view> machines;  ///< paths of their active states

 private:
  const component::Component& component_;
};

/// The whole interface; where it stands now is left out.
/// @param snapshot  nullptr: nobody asked, or nobody answered
/// @thread the controlling one of its application
ComponentDescription describe_interface(const component::Component& component,
                                        const Snapshot* snapshot, Values values);

}  // namespace armature::inspect::internal
