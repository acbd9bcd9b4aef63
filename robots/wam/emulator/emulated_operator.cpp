// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulated_operator.hpp"

#include <chrono>
#include <utility>

namespace armature::wam {
namespace {

constexpr double kCarriedHome = 1e-6;  // [rad]
/// Between two keys.
constexpr base::Duration kKeyTime = std::chrono::milliseconds(100);

}  // namespace

void EmulatedOperator::bring_to_idle() {
  carry_home();
  while (arm_.from_home() > kCarriedHome) {
    arm_.wait_for_news(arm_.now() + std::chrono::milliseconds(10));
  }
  press_reset();
  press_idle();
}

void EmulatedOperator::help_to_activate(bool idle_first, base::Time now) {
  if (!std::exchange(asked_, true)) pressed_at_ = now;
  if (now - pressed_at_ < kKeyTime) return;
  pressed_at_ = now;
  idle_first ? press_idle() : press_activate();
}

}  // namespace armature::wam
