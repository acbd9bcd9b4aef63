// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/way_home.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "armature/rt/guard.hpp"

namespace armature::wam {
namespace {

/// [rad/s] of all joints together.
constexpr double kHomeRate = 0.5;
/// In which a motion that was cancelled has come to rest.
constexpr base::Duration kRestTime = std::chrono::seconds(2);

/// [s] Of a motion of which no part is faster than twice its mean.
double home_time(const WayHome::Arm& arm) {
  double length = 0.0;
  for (std::size_t i = 0; i < arm.home.size(); ++i) {
    length = std::hypot(length, arm.home[i] - arm.positions[i]);
  }
  return 2.0 * length / kHomeRate;
}

}  // namespace

component::Outcome WayHome::begin(const Arm& arm) {
  if (!generator_.bound()) return component::refused("it has no peer with a command moveTo");
  asked_at_ = arm.time;
  send(arm, false);
  by_limits_ = false;
  gave_way_ = false;
  if (is_refused()) send(arm, true);  // short ways take longer
  if (is_refused()) return component::refused(motion_.reason());
  return component::accepted();
}

void WayHome::send(const Arm& arm, bool by_limits) {
  const rt::PermitScope first_target_makes_room;
  motion_ = generator_.send(arm.home, by_limits ? 0.0 : home_time(arm));
}

std::string_view WayHome::reason() const {
  return gave_way_ ? "another motion is under way" : motion_.reason();
}

bool WayHome::follow(const Arm& arm) {
  if (waits()) {
    gave_way_ = true;
    motion_.cancel();
  }
  if (!motion_.ended()) return false;
  // A motion that was cancelled comes to rest first.
  const bool in_time = arm.time - asked_at_ < kRestTime;
  if (!in_time || !(is_refused() || gave_way_)) return true;
  if (std::exchange(gave_way_, false)) {
    send(arm, by_limits_);
    return false;
  }
  // It rests already if only the time is refused, which is too short for a short way.
  by_limits_ = !by_limits_;
  send(arm, by_limits_);
  return false;
}

}  // namespace armature::wam
