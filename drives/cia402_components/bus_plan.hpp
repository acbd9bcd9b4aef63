// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/author.hpp"
#include "drives/cia402_components/drive_plan.hpp"

namespace armature::cia402 {

class Cia402Host;

/// Refuses numbers of drives that are none, come twice, or are the host's own; 0: it has none.
/// @thread configuration only, as for the next ones
void check_nodes(const std::vector<int>& nodes, int host_node, component::Check& check);

/// Puts what each drive's component says in place of what the host says of all, reads their EDS
/// files, and refuses two components with one number.
void refine_plans(const Cia402Host& host, std::span<DrivePlan> plans, component::Check& check);

/// Refuses a bus on which a cycle's frames take longer than its period.
void check_bus_time(std::span<const DrivePlan> plans, std::uint32_t bit_rate, base::Duration period,
                    component::Check& check);

/// Refuses a Robot that says that fewer joints answer two cycles late than there are drives in the
/// modes torque and velocity: gains would be judged by another delay than they have.
void check_answer_time(std::span<const DrivePlan> plans, base::Duration period,
                       component::Check& check);

}  // namespace armature::cia402
