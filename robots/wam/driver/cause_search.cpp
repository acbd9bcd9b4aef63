// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/cause_search.hpp"

#include <chrono>
#include <utility>

namespace armature::wam {
namespace {

/// Until then the board says why it went to idle; the driver asks it at once.
constexpr base::Duration kIdleCauseTime = std::chrono::milliseconds(150);
/// Until then it says whether it was E-stop that made pucks silent, and those that can hear answer.
constexpr base::Duration kSilenceCauseTime = std::chrono::milliseconds(30);
/// Until then it has cut the power of those that do not.
constexpr base::Duration kPowerCutTime = std::chrono::milliseconds(50);

}  // namespace

void CauseSearch::forget() {
  since_.reset();
  cuts_power_ = false;
}

CauseSearch::Found CauseSearch::look_at_idle(base::Time now) {
  if (now - since_.value_or(now) < kIdleCauseTime) return Found::kNothingYet;
  since_.reset();
  return Found::kOperator;
}

CauseSearch::Found CauseSearch::look_at_silence(WamDriver& driver, base::Time now) {
  const base::Duration past = now - since_.value_or(now);
  driver.send_idle();  // in each cycle: it may have missed the last
  if (past < kSilenceCauseTime) return Found::kNothingYet;
  if (past >= kPowerCutTime || !driver.any_silent()) return Found::kFault;
  if (driver.needs_power_cut() && !std::exchange(cuts_power_, true)) driver.cut_power(now);
  return Found::kNothingYet;
}

}  // namespace armature::wam
