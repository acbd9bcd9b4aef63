// SPDX-License-Identifier: Apache-2.0
// Everything that may break in the arm's motion, and what is promised of each.
#pragma once

#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "tests/wam/campaign_arm.hpp"

namespace armature::wam {

using Random = std::mt19937;

/// What becomes of the arm.
enum class After {
  kGoesOn,  ///< the motion is made to its end
  kBrakes,  ///< it comes to rest, armed still, and the motion is not gone on with
  kHeld,    ///< disarmed, the hardware brakes it and holds it where it came to rest
  kIdled,   ///< disarmed, the pucks brake; the hardware waits for the operator's activation
  kFault,   ///< the hardware is out of service, the pucks brake; reset and start bring it back
  kLost,    ///< the same, and pucks have lost their positions: the program is begun again
};

struct Breakage {
  const char* name = "";
  std::function<void(CampaignArm&, Random&)> happens{};
  After after = After::kGoesOn;
  /// Of the reason for a fault, or of the hardware's log where it is disarmed.
  const char* said = "";
  std::function<void(CampaignArm&)> ends = [](CampaignArm&) {};
  /// False where neither pucks nor board hear anybody: motors go on as they were told last, until
  /// the operator's E-stop takes their power. Judged from there on.
  bool brakes = true;
};

/// What the test prints of it.
inline void PrintTo(const Breakage& breakage, std::ostream* out) { *out << breakage.name; }

std::vector<Breakage> breakages();

}  // namespace armature::wam
