// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/link.hpp"
#include "robots/wam/arm_numbers.hpp"
#include "robots/wam/driver/wam_record.hpp"
#include "robots/wam/driver/wam_startup.hpp"

namespace armature::wam {

struct ArmConnectionConfig {
  base::Duration patience = std::chrono::seconds(5);  ///< for the operator to bring it to idle
  /// The operator says that the arm is at home: where a board without positions is zeroed.
  bool at_home = false;
  /// What he sets to true to say so.
  std::string word = "at_home";
  /// Called when the operator has to bring the arm to idle, and every 15 s from then on, with what
  /// the board said last, and how long it is still waited for.
  std::function<void(std::optional<BoardMode>, base::Duration left)> ask_for_idle{};
};

/// All that is said to the arm between power-up and the cycle (WamStartup): waits for idle as long
/// as patience lasts, wakes the pucks, and zeroes them if the board says that they have lost their
/// positions. The error says why not, and what to do. Takes seconds of the link's time.
/// @param link      whose bus is open
/// @param warnings  what is odd but works
base::Result<WamRecord> connect_arm(can::Link& link, const ArmNumbers& numbers,
                                    const ArmConnectionConfig& config,
                                    std::vector<std::string>& warnings);

}  // namespace armature::wam
