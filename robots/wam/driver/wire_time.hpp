// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"

namespace armature::wam {

/// How a cycle spent the bus.
struct CycleOnWire {
  base::Duration bus{};     ///< from the cycle's begin to the end of its last frame
  base::Duration frames{};  ///< the frames' own time, with the bits until another may begin
  std::size_t count = 0;    ///< of frames
};

/// For each cycle what was on the wire between its begin and the next one's.
/// @param begins  of the cycles, in their order
/// @param log     all frames, in the order of the wire
/// @param period  of the last cycle
std::vector<CycleOnWire> cycles_on_wire(const std::vector<base::Time>& begins,
                                        const std::vector<can::WireEvent>& log,
                                        base::Duration period);

}  // namespace armature::wam
