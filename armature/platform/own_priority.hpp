// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::platform {

/// The real-time priority of the calling thread, 1 to 99; 0 if the ordinary scheduler runs it.
int own_priority();

/// Gives the calling thread this real-time priority, by SCHED_FIFO.
/// @param priority  1 to 99
/// @return false if the system refuses: nothing has changed then
bool set_own_priority(int priority);

}  // namespace armature::platform
