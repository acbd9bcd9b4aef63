// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robots/rover/following.hpp"

// What the report of the rover shows beside figures: curves, ways from above, images.
namespace armature::rover {

/// The phases of experiment.lua.
enum Phase : int {
  kResting = 1,
  kTurned = 2,
  kLine = 3,
  kCircle = 4,
  kEight = 5,
  kHidden = 6,
  kCarried = 7,
};
/// Until what rolls steadily is followed steadily, with the way to where it begins [s].
constexpr double kSettledOnCircle = 20.0;
constexpr double kSettledOnEight = 8.0;

/// Adds `curves` and `ways` of a run.
void add_curves(const std::string& run, const std::vector<Sight>& sights,
                nlohmann::ordered_json& figures);
/// The same of how late positions came in real time.
void add_lateness(const std::vector<double>& time_s, const std::vector<double>& late_ms,
                  nlohmann::ordered_json& figures);
/// Looks at images of the arena: 10 000 without a ball, and some with one, which `pictures` has
/// with what was seen in them. Adds how long a look takes, too.
void add_pictures(nlohmann::ordered_json& figures);

}  // namespace armature::rover
