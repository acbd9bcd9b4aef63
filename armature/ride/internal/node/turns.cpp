// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/turns.hpp"

#include <algorithm>
#include <chrono>
#include <new>

#include "armature/platform/clock.hpp"

namespace armature::ride::internal {
namespace {

/// Messages that arrive while others are dispatched wait no longer for their turn.
constexpr base::Duration kTurns = std::chrono::microseconds(20);
/// What is larger may take long.
constexpr std::size_t kLargeBody = 4 * 1024;
/// What takes longer is followed by a pause of so many times as long, in which no other such
/// message is executed.
constexpr base::Duration kLongTurn = std::chrono::microseconds(200);
constexpr int kPauseFactor = 20;
constexpr base::Duration kLongestPause = std::chrono::milliseconds(100);

}  // namespace

void Turns::take(bool alone) {
  constexpr int kBetweenLooks = 2;
  base::Time end{};
  for (int i = 1; !pending_.empty(); ++i) {
    const Pending::Entry entry = pending_.pop();
    const bool is_large = entry.message.body.size() >= kLargeBody;
    if (entry.link->waiting.has_large()) {
      dispatch_large(*entry.link, entry.message, alone);
    } else {
      dispatch(*entry.link, entry.message);
    }
    entry.link->waiting.settle();
    entry.link->let_go_if_leaving();
    if (i % kBetweenLooks != 0 && !is_large) continue;
    const base::Time now = platform::monotonic_now();
    if (end == base::Time{}) end = now + kTurns;
    if (now >= end) return;
  }
}

/// While one that takes long is executed all others wait: after it there is time for them, before
/// the next one of whomever.
void Turns::dispatch_large(Link& link, const Message& message, bool alone) {
  const base::Time before = platform::monotonic_now();
  dispatch(link, message);
  const base::Time now = core_.clock.look();
  const base::Duration took = now - before;
  if (took < kLongTurn || alone) return;
  large_from_ = now + std::min(kPauseFactor * took, kLongestPause);
  pending_.hold_large();
  core_.clock.wake_at(large_from_);
}

void Turns::dispatch(Link& link, const Message& message) {
  dispatches_ = true;
  try {
    dispatcher_.dispatch(link, message);
  } catch (const std::bad_alloc&) {
    link.refuse(Code::kBusy, message, "not enough memory for it");
  }
  dispatches_ = false;
}

void Turns::look_at_timers() {
  if (!pending_.holds_large()) return;
  if (core_.clock.now() >= large_from_) {
    pending_.release_large();
  } else {
    core_.clock.wake_at(large_from_);
  }
}

void Turns::refuse_all(const char* why) {
  pending_.release_large();
  while (!pending_.empty()) {
    const Pending::Entry entry = pending_.pop();
    entry.link->refuse(Code::kShuttingDown, entry.message, why);
  }
}

}  // namespace armature::ride::internal
