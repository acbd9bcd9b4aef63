// SPDX-License-Identifier: Apache-2.0
// Everything that may break in a motion of drives by CiA 402, and what is promised of each.
#pragma once

#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "tests/drives/campaign_arm.hpp"

namespace armature::cia402 {

using Random = std::mt19937;

/// What becomes of the arm.
enum class After {
  kGoesOn,  ///< the motion is made to its end
  kBrakes,  ///< it comes to rest, armed still, and the motion is not gone on with
  kRests,   ///< one of these two: what was desired has torques wind up, and who stands still for it
            ///< is watched
  kStopped,  ///< it comes to rest, no drive is enabled; reset, start and arm bring it back
  /// The same as soon as it can be seen, at the latest with the next motion: until then its joint
  /// is as near to where it was told to be as MaxPositionError allows.
  kStoppedOnceSeen,
  kLost,  ///< the same, and reset and start alone do not: the program is begun again
};

struct Breakage {
  const char* name = "";
  std::function<void(CampaignArm&, Random&)> happens{};
  After after = After::kStopped;
  /// Of the reason of what is out of service afterwards; any of these.
  std::vector<std::string> said{};
  std::function<void(CampaignArm&)> ends = [](CampaignArm&) {};
};

/// What the test prints of it.
inline void PrintTo(const Breakage& breakage, std::ostream* out) { *out << breakage.name; }

std::vector<Breakage> breakages();

}  // namespace armature::cia402
