// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/reception.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::ride::internal {
namespace {

/// Who has sent so many messages at once, or bytes, sends much.
constexpr std::uint64_t kManyMessages = 64;
constexpr std::size_t kManyBytes = 4 * 1024;

}  // namespace

void Reception::read(Link& link) {
  if (!link.sends_much) return receive(link);
  if (!std::exchange(link.waits_for_turn, true)) greedy_.push_back(&link);
}

void Reception::read_next() {
  if (greedy_.empty()) return;
  Link& link = *greedy_.front();
  greedy_.pop_front();
  link.waits_for_turn = false;
  receive(link);
  link.look_again();
}

void Reception::forget(Link& link) {
  if (std::exchange(link.waits_for_turn, false)) std::erase(greedy_, &link);
}

void Reception::receive(Link& link) {
  const std::uint64_t before = link.received();
  std::size_t size = 0;
  watch_incomplete(link, link.read(size));
  const std::uint64_t count = link.received() - before;
  link.let_go_if_leaving();
  link.sends_much = count >= kManyMessages || size >= kManyBytes;
  link.window_messages += count;
  if (link.window_messages > core_.options.limits.messages_per_second) throttle(link);
}

/// Asks what time it is only where that matters.
void Reception::watch_incomplete(Link& link, std::optional<std::uint64_t> incomplete) {
  if (!incomplete) {
    link.incomplete_since = base::Time::max();
  } else if (link.incomplete_since == base::Time::max() || *incomplete != link.incomplete_message) {
    link.incomplete_message = *incomplete;
    link.incomplete_since = platform::monotonic_now();
    core_.clock.wake_at(base::later(link.incomplete_since, core_.options.limits.time_to_complete));
  }
}

/// The window may have been over long ago.
void Reception::throttle(Link& link) {
  constexpr base::Duration kWindow = std::chrono::seconds(1);
  const base::Time now = platform::monotonic_now();
  link.window_messages = 0;
  if (now >= std::exchange(link.window_end, now + kWindow)) return;
  Counters::increase(core_.counters.throttled);
  core_.journal.tell(rt::LogLevel::kWarning,
                     "{} sends more than {} messages a second: it must wait", link.other_end(),
                     core_.options.limits.messages_per_second);
  link.set_throttled(true);
  core_.clock.wake_at(link.window_end);
}

void Reception::look_at_timers(Link& link) {
  const base::Time now = core_.clock.now();
  if (link.throttled) {
    if (now >= link.window_end) {
      link.set_throttled(false);
    } else {
      core_.clock.wake_at(link.window_end);
    }
  }
  if (link.incomplete_since == base::Time::max()) return;
  const base::Time end = base::later(link.incomplete_since, core_.options.limits.time_to_complete);
  if (now < end) return core_.clock.wake_at(end);
  if (!link.established) return link.break_off("the handshake did not end in time");
  if (link.incomplete() != link.incomplete_message) {  // a caller has read on
    link.incomplete_since = base::Time::max();
    return;
  }
  core_.journal.tell(rt::LogLevel::kWarning, "{} is disconnected: its message did not end in time",
                     link.other_end());
  link.break_off("a message did not end in time");
}

}  // namespace armature::ride::internal
