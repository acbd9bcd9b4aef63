// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robots/janus/plant.hpp"

namespace armature::janus {

/// `{"time":1.5,"position":[0,0],"state":["on","off"],"brake_released":[true,false]}`
/// @param time  in seconds since the plant was started
std::string json_line(const PlantState& state, double time);

/// Tells people what changes.
class ChangeReport {
 public:
  /// A line for each change since the state before, with the time.
  std::vector<std::string> take(const PlantState& state, double time);

 private:
  std::optional<PlantState> before_;
};

}  // namespace armature::janus
