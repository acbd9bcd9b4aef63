// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wire_time.hpp"

namespace armature::wam {

std::vector<CycleOnWire> cycles_on_wire(const std::vector<base::Time>& begins,
                                        const std::vector<can::WireEvent>& log,
                                        base::Duration period) {
  std::vector<CycleOnWire> cycles;
  auto event = log.begin();
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const base::Time end = i + 1 < begins.size() ? begins[i + 1] : begins[i] + period;
    CycleOnWire cycle;
    while (event != log.end() && event->begin < begins[i]) ++event;
    for (; event != log.end() && event->begin < end; ++event) {
      cycle.bus = event->end - begins[i];
      cycle.frames += event->end - event->begin;
      ++cycle.count;
    }
    cycles.push_back(cycle);
  }
  return cycles;
}

}  // namespace armature::wam
