// SPDX-License-Identifier: Apache-2.0
// WamHardware: who sets the pucks idle if this process cannot any more.
#include "armature/base/seconds.hpp"
#include "robots/wam/driver/wam_guard.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {

component::Outcome WamHardware::guard_arm() {
  if (context().simulated) return component::accepted();
  const component::Outcome outcome =
      emulated_ != nullptr ? guard_.do_without("the emulated arm ends with this process")
                           : guard_.start(guard_orders(driver_->arm(), bus_,
                                                       base::from_seconds(parameters_.period())));
  if (!outcome || guard_.said().empty()) return outcome;
  guard_.complains() ? log_warning("{}", guard_.said()) : log_info("{}", guard_.said());
  return outcome;
}

/// @return it runs on
bool WamHardware::is_guarded() {
  if (const auto reason = guard_.beat(time())) {
    leave_service();
    fault(reason->view());
    return false;
  }
  if (guard_.take_loss()) {
    log_error("its guardian has died: if this process does, the pucks' watchdogs stop the arm");
  }
  return true;
}

}  // namespace armature::wam
