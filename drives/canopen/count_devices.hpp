// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "armature/can/link.hpp"
#include "drives/canopen/cob_id.hpp"

namespace armature::canopen {

/// How many devices answer as this node: two with one number answer a question twice. Answers that
/// fall together to the bit are one on a wire, so 1 is no proof.
/// @param patience  with all answers
/// @thread the host's, and not in its cycle: waits
int count_devices(can::Link& link, NodeId node,
                  base::Duration patience = std::chrono::milliseconds(10));

}  // namespace armature::canopen
