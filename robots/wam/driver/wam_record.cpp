// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wam_record.hpp"

#include <algorithm>
#include <utility>

#include "robots/wam/protocol/puck_properties.hpp"

namespace armature::wam {
namespace {

bool contains(const std::array<int, 3>& groups, int group) {
  return std::ranges::find(groups, group) != groups.end();
}

std::optional<Mistake> check_values(const PuckRecord& puck) {
  for (const auto& [property, value] : {std::pair{Property::kCts, puck.counts_per_turn},
                                        std::pair{Property::kIpnm, puck.units_per_nm},
                                        std::pair{Property::kMt, puck.most_torque}}) {
    if (value > 0) continue;
    return Mistake{"puck " + std::to_string(puck.node) + " has " + to_text(property) + " " +
                       std::to_string(value) + ", expected above 0",
                   "write the value of the maker's data sheet and save it"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Mistake> check_motor(int node, int role, int status) {
  if ((role & kKindMask) != kMotorRole) {
    return Mistake{"puck " + std::to_string(node) + " has role " +
                       std::to_string(role & kKindMask) + ", expected 0, a motor puck",
                   "only motor pucks may have numbers 1 to 7"};
  }
  if (status == static_cast<int>(PuckStatus::kReset) ||
      status == static_cast<int>(PuckStatus::kReady)) {
    return std::nullopt;
  }
  return Mistake{"puck " + std::to_string(node) + " has status " + std::to_string(status) +
                     ", expected 0 (reset) or 2 (ready)",
                 "switch the arm off and on; if that does not help, the puck is broken"};
}

std::optional<Mistake> check_puck(const PuckRecord& puck) {
  if (auto mistake = check_values(puck)) return mistake;
  const int last_of_lower_arm = static_cast<int>(kTorquesPerFrame);
  const bool wrist = puck.node > last_of_lower_arm;
  const int slot = wrist ? puck.node - last_of_lower_arm : puck.node;
  if (puck.slot != slot) {
    return Mistake{"puck " + std::to_string(puck.node) + " takes torque " +
                       std::to_string(puck.slot) + " of its frame (PIDX), expected " +
                       std::to_string(slot),
                   "set PIDX to " + std::to_string(slot) + " and save it"};
  }
  const int torques = static_cast<int>(wrist ? Group::kWrist : Group::kLowerArm);
  if (contains(puck.groups, torques) && contains(puck.groups, static_cast<int>(Group::kArm))) {
    return std::nullopt;
  }
  return Mistake{"puck " + std::to_string(puck.node) + " is in groups " +
                     std::to_string(puck.groups[0]) + ", " + std::to_string(puck.groups[1]) +
                     " and " + std::to_string(puck.groups[2]) + ", expected 0, " +
                     std::to_string(torques) + " for torques and 4 for positions",
                 "set GRPA, GRPB and GRPC to these and save them"};
}

}  // namespace armature::wam
