// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"

namespace armature::wam {

/// The cycles of one of the arm's deployments while it moves.
struct DeployedCycles {
  std::vector<base::Time> begins;    ///< of the Sample events, on the bus's clock
  std::vector<double> computing_us;  ///< all that the application did in the period
  std::vector<can::WireEvent> wire;  ///< all frames
};

/// Runs the deployment on the emulated arm in simulated time: it is armed, and moves all joints in
/// one motion. Throws std::runtime_error if the arm does not follow to its end.
/// @param deployment  a file of robots/wam/deployments
/// @param libraries   the folder of the component libraries
/// @param target      [rad] of the joints, where the motion ends
DeployedCycles run_deployed(const std::string& deployment, const std::string& libraries,
                            const std::vector<double>& target, std::size_t cycles,
                            base::Duration period);

}  // namespace armature::wam
