// SPDX-License-Identifier: Apache-2.0
// Of NodeState: what its time has come for.
#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/node_state.hpp"
#include "armature/ride/internal/peer_state.hpp"

namespace armature::ride::internal {

/// The poller is told of times that are far away: they are asked for seldom, it waits often.
base::Duration NodeState::time_left() {
  poller_->wake_at(std::min(due_, return_at_));
  if (flush_at_ == base::Time::max()) return base::Duration::max();
  return flush_at_ - platform::monotonic_now();
}

void NodeState::look_at_clock() {
  now_ = platform::monotonic_now();
  if (now_ >= flush_at_) flush_gathered();
  if (now_ >= return_at_) take_back_lent();
  if (now_ >= due_) look_at_timers();
}

/// The window may have been over long ago.
void NodeState::throttle(Link& link) {
  constexpr base::Duration kWindow = std::chrono::seconds(1);
  const base::Time now = platform::monotonic_now();
  link.window_messages = 0;
  if (now >= std::exchange(link.window_end, now + kWindow)) return;
  counters_.throttled.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, "{} sends more than {} messages a second: it must wait",
                link.other_end(), options_.limits.messages_per_second);
  link.set_throttled(true);
  wake_at(link.window_end);
}

void NodeState::flush_gathered() {
  std::erase_if(flushed_, [&](const auto& link) { return !link->flush(now_, kFlushAge); });
  flush_at_ = flushed_.empty() ? base::Time::max() : now_ + kFlushAge;
}

void NodeState::take_back_lent() {
  std::erase_if(lent_, [](const auto& link) { return link->take_back(); });
  return_at_ = lent_.empty() ? base::Time::max() : now_ + kLending;
}

void NodeState::look_at_timers() {
  due_ = base::Time::max();
  wake_at(entrance_.look_at_time(now_));
  if (pending_.holds_large()) {
    if (now_ >= large_from_) {
      pending_.release_large();
    } else {
      wake_at(large_from_);
    }
  }
  const auto links = links_;  // One that ends is taken from the list.
  for (const auto& link : links) look_at_link(*link);
  if (memory_->is_in_use()) free_memory();
  for (const auto& peer : peers_) {
    look_at_link(peer->state()->link());
    wake_at(peer->state()->look_at_timers(now_));
  }
}

/// What all share is not for those who do not take what they are sent.
void NodeState::free_memory() {
  for (const auto& link : links_) link->end_if_stuck(now_, options_.limits.time_to_complete);
  wake_at(base::later(now_, options_.limits.time_to_complete / 4));
}

void NodeState::look_at_link(Link& link) {
  if (link.throttled) {
    if (now_ >= link.window_end) {
      link.set_throttled(false);
    } else {
      wake_at(link.window_end);
    }
  }
  if (link.incomplete_since == base::Time::max()) return;
  const base::Time end = base::later(link.incomplete_since, options_.limits.time_to_complete);
  if (now_ < end) return wake_at(end);
  if (!link.established) return link.break_off("the handshake did not end in time");
  if (link.incomplete() != link.incomplete_message) {  // a caller has read on
    link.incomplete_since = base::Time::max();
    return;
  }
  journal_.tell(rt::LogLevel::kWarning, "{} is disconnected: its message did not end in time",
                link.other_end());
  link.break_off("a message did not end in time");
}

}  // namespace armature::ride::internal
