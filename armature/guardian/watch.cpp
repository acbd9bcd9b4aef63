// SPDX-License-Identifier: Apache-2.0
#include "armature/guardian/internal/watch.hpp"

namespace armature::guardian::internal {
namespace {

constexpr std::int64_t least(std::int64_t a, std::int64_t b) { return a < b ? a : b; }

}  // namespace

Act Watch::look(const Sight& sight) {
  const bool was_late = next_ != 0 && sight.now > next_ + kOwnLateness;
  if (sight.ended) return Act::kEnd;
  if (sight.dead) {
    return cause_ == Cause::kDeath ? go_on(sight) : begin_to_act(sight, Cause::kDeath);
  }
  const bool known = sight.acknowledged == acted_;
  if (!sight.watched || (cause_ != Cause::kNone && known)) cause_ = Cause::kNone;
  if (!sight.watched) return look_again(sight.now + kQuietLook);
  return cause_ == Cause::kNone ? watch(sight, was_late) : go_on(sight);
}

Act Watch::watch(const Sight& sight, bool was_late) {
  // What is not of now is no cycle: a process that dies may have written anywhere.
  if (sight.beat <= sight.now + period_) beat_ = sight.beat;
  const std::int64_t missed = kMostMissedPeriods * period_;
  if (sight.now < beat_ + missed) return look_again(least(beat_ + missed, sight.now + kQuietLook));
  const std::int64_t patience = kMostPatience > 2 * missed ? kMostPatience : 2 * missed;
  if (was_late && sight.now < beat_ + patience) return look_again(sight.now + period_);
  return begin_to_act(sight, Cause::kNoCycle);
}

Act Watch::begin_to_act(const Sight& sight, Cause cause) {
  if (cause_ == Cause::kNone) {
    ++acted_;
    silence_ = sight.now - least(beat_, sight.now);
  }
  cause_ = cause;
  begun_ = sight.now;
  next_ = sight.now + period_;
  return Act::kSend;
}

Act Watch::go_on(const Sight& sight) {
  if (cause_ == Cause::kDeath && sight.idle) return Act::kEnd;
  const std::int64_t insistence = sight.bus ? kMostInsistence : kMostWithoutBus;
  if (cause_ == Cause::kDeath && sight.now > begun_ + insistence) return Act::kGiveUp;
  if (sight.now < next_) return Act::kNothing;
  next_ = sight.now + (sight.idle ? kReminder : period_);
  return Act::kSend;
}

Act Watch::look_again(std::int64_t at) {
  next_ = at;
  return Act::kNothing;
}

}  // namespace armature::guardian::internal
