// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_bus.hpp"

#include "robots/janus/aic/aic_guard.hpp"

namespace armature::janus {

component::Outcome AicBus::begin_to_guard() {
  if (is_simulated()) return component::accepted();
  const component::Outcome outcome =
      period() == base::Duration::zero()
          ? guard_.do_without("no component calls it in a cycle of one period")
          : guard_.start(guard_orders(cards(), bus_.get(), bit_rate(), period()));
  if (!outcome || guard_.said().empty()) return outcome;
  guard_.complains() ? log_warning("{}", guard_.said()) : log_info("{}", guard_.said());
  return outcome;
}

bool AicBus::is_guarded() {
  if (const auto reason = guard_.beat(time())) {
    make_safe();
    fault(reason->view());
    return false;
  }
  if (guard_.take_loss()) {
    log_error("its guardian has died: if this process does, the cards' watchdogs stop the joints");
  }
  return true;
}

}  // namespace armature::janus
