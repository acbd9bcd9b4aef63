// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/base/result.hpp"
#include "armature/can/link.hpp"
#include "drives/cia402/drive_group.hpp"
#include "drives/cia402_components/drive_plan.hpp"

namespace armature::cia402 {

/// Waits while frames come and go.
/// @thread configuration only, as for all here
void pass_time(can::Link& link, base::Duration time);

/// Compares each drive on the bus with its plan, has it prepared, and starts all by NMT. An error
/// tells all that is wrong with all drives at once.
/// @param asks_slowly  numbers that no PDO has are asked for
base::Result<DriveGroup> prepare_bus(can::Link& link, const std::vector<DrivePlan>& plans,
                                     bool asks_slowly);

/// Has each drive expect the heartbeat of its host. One that does not take it now is seen by its
/// missing answers.
void announce_heartbeat(can::Link& link, const std::vector<DrivePlan>& plans);

}  // namespace armature::cia402
