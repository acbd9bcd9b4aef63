// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"

namespace armature::exec {

/// One cycle of a thread, step by step.
struct RecordedCycle {
  /// A component ran, without what it called.
  struct Step {
    const component::Component* component = nullptr;
    base::Duration begin{};  ///< since the cycle's
    base::Duration length{};
  };
  std::uint64_t number = 0;  ///< the thread's, from 1; 0: none was recorded yet
  base::Time time{};         ///< that components were told
  base::Duration length{};
  std::vector<Step> steps;     ///< in the order of their begin
  std::uint64_t left_out = 0;  ///< steps that found no room
};

}  // namespace armature::exec
