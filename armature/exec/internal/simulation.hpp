// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/engine.hpp"

namespace armature::exec::internal {

/// Lets engines take turns in simulated time: by time, then by urgency, then by declaration.
class Simulation {
 public:
  /// @param engines  in the order of their declaration
  explicit Simulation(const std::vector<Engine*>& engines);

  /// One turn of whoever comes first at `now`; nullptr if nobody has anything to do.
  Engine* take_turn(base::Time now);

  /// When somebody has something to do next; the end of time if nobody has.
  base::Time next_due() const;

 private:
  Engine* find_next(base::Time now) const;

  std::vector<Engine*> by_urgency_;
  base::Time instant_ = base::Time::min();
  std::uint64_t turns_at_instant_ = 0;
};

}  // namespace armature::exec::internal
