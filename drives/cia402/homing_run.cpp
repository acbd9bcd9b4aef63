// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/homing_run.hpp"

#include <utility>

namespace armature::cia402 {
namespace {

/// In which a drive that does not move takes the start bit, and bits of a run before are gone.
constexpr int kCyclesToTakeStart = 10;
constexpr std::uint16_t kHomingAttained = status_bit::kAcknowledge;
constexpr std::uint16_t kHomingError = status_bit::kFollowingError;

bool can_move(std::optional<PowerState> power) {
  return !power || *power == PowerState::kOperationEnabled ||
         *power == PowerState::kQuickStopActive || *power == PowerState::kFaultReactionActive;
}

bool shows(const HomingRun::Seen& seen, Mode mode) {
  return seen.mode && *seen.mode == static_cast<std::int64_t>(mode);
}

}  // namespace

HomingStage HomingRun::stage() const {
  switch (state_) {
    case State::kIdle:
      return HomingStage::kIdle;
    case State::kAttained:
      return HomingStage::kAttained;
    case State::kFailed:
      return HomingStage::kFailed;
    case State::kStopping:
    case State::kReturning:
      return HomingStage::kLeaving;
    default:
      return HomingStage::kUnderWay;
  }
}

bool HomingRun::begin() noexcept {
  if (state_ != State::kIdle) return false;
  state_ = State::kChangingMode;
  return true;
}

void HomingRun::leave() noexcept {
  if (state_ != State::kIdle && state_ != State::kReturning) state_ = State::kStopping;
  enables_ = false;
}

HomingRun::Order HomingRun::step(const Seen& seen) noexcept {
  go_on(seen);
  const bool homes = state_ != State::kIdle && state_ != State::kReturning;
  return {.mode = homes ? Mode::kHoming : cyclic_,
          .starts = state_ == State::kMoving || state_ == State::kAttained,
          .enables = std::exchange(enables_, false)};
}

void HomingRun::go_on(const Seen& seen) noexcept {
  const bool enabled = seen.power == PowerState::kOperationEnabled;
  switch (state_) {
    case State::kChangingMode:
      if (!shows(seen, Mode::kHoming)) return;
      state_ = State::kSwitchingOn;
      enables_ = true;
      return;
    case State::kSwitchingOn:
      if (!enabled) return;
      state_ = State::kMoving;
      has_begun_ = (seen.status & kHomingAttained) == 0;
      cycles_ = 0;
      return;
    case State::kMoving:
      if (enabled) return follow(seen.status);
      state_ = State::kFailed;
      return;
    case State::kAttained:
      if (!enabled) state_ = State::kFailed;
      return;
    case State::kStopping:
      if (!can_move(seen.power)) state_ = State::kReturning;
      return;
    case State::kReturning:
      if (shows(seen, cyclic_)) state_ = State::kIdle;
      return;
    default:
      return;
  }
}

/// Attained bits of a run before say nothing of this one: a drive that moves takes them back first.
void HomingRun::follow(std::uint16_t status) noexcept {
  ++cycles_;
  const bool attained = (status & kHomingAttained) != 0;
  const bool stands = (status & status_bit::kTargetReached) != 0;
  if (!attained || (!moves_ && cycles_ > kCyclesToTakeStart)) has_begun_ = true;
  if (cycles_ <= kCyclesToTakeStart) return;
  if ((status & kHomingError) != 0) {
    state_ = State::kFailed;
  } else if (has_begun_ && attained && stands) {
    state_ = State::kAttained;
  }
}

}  // namespace armature::cia402
