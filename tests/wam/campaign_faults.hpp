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

/// Whose puck a command of the emulator is for.
enum class OfPuck { kAny, kLowerArm, kWrist };

struct Breakage {
  const char* name = "";
  std::function<void(CampaignArm&, Random&)> happens{};
  /// Of the emulator, in place of `happens`; N stands for a puck.
  const char* command = "";
  OfPuck puck = OfPuck::kAny;
  After after = After::kGoesOn;
  /// Of the reason for a fault, or of the hardware's log where it is disarmed.
  const char* said = "";
  std::function<void(CampaignArm&)> ends = [](CampaignArm&) {};
  /// False where neither pucks nor board hear anybody: motors go on as they were told last, until
  /// the operator's E-stop takes their power. Judged from there on.
  bool brakes = true;
  bool of_wrist() const { return puck == OfPuck::kWrist; }
};

/// What the test prints of it.
inline void PrintTo(const Breakage& breakage, std::ostream* out) { *out << breakage.name; }

std::vector<Breakage> breakages();
/// Any of these.
int node_for(OfPuck puck, CampaignArm& arm, Random& random);
void break_arm(const Breakage& breakage, CampaignArm& arm, Random& random);

}  // namespace armature::wam
