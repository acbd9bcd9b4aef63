// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "armature/base/time.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::rt {

/// Wakes sleeping threads at times that they name, so that they sleep without a timer of their own:
/// the system arms and disarms one at every sleep, which is a tenth of a short cycle. One thread,
/// the watch, has the only timer, which stays as it is while all that happens is that times are put
/// off.
///
/// Specification: a sleeper is notified at the time that it set last or later, never left asleep,
/// whatever it set before; it may be notified without need.
template <typename Parker>
class BasicAlarms {
 public:
  using Wakeup = BasicWakeup<Parker>;

  /// Before anything runs. Returns the sleeper's number.
  std::size_t add(Wakeup& sleeper) {
    entries_.emplace_back(sleeper);
    return entries_.size() - 1;
  }
  bool empty() const { return entries_.empty(); }

  /// By when it wants to be woken at the latest; the end of time: not at all.
  /// @rt nonblocking; a system call only if that is earlier than what it set before
  /// @thread the sleeper's
  void set(std::size_t sleeper, base::Time due) {
    const std::int64_t wanted = due.time_since_epoch().count();
    const std::int64_t before = entries_[sleeper].due.exchange(wanted, std::memory_order_acq_rel);
    if (wanted < before) watch_.notify();
  }

  /// Notifies those whose time has come; returns when the next one's will.
  /// @rt nonblocking, O(sleepers); a system call for each that is woken
  /// @thread the watch
  base::Time ring(base::Time now) {
    const std::int64_t come = now.time_since_epoch().count();
    std::int64_t next = kNever;
    for (Entry& entry : entries_) next = std::min(next, ring(entry, come));
    return base::Time(base::Duration(next));
  }

  /// Until then, or until somebody set an earlier time; false if the time ran out.
  /// @thread the watch
  bool wait_until(base::Time next) {
    if (next < base::Time::max()) return watch_.wait_until(next);
    watch_.wait();
    return true;
  }

  /// Has the watch look now.
  /// @thread any
  void wake_watch() { watch_.notify(); }

 private:
  static constexpr std::int64_t kNever = base::Time::max().time_since_epoch().count();

  struct Entry {
    explicit Entry(Wakeup& sleeper) : wakeup(&sleeper) {}
    typename Parker::Atomics::template Atomic<std::int64_t> due{kNever};
    Wakeup* wakeup;
  };

  /// Nobody else makes a time earlier without a notification, and what is put off meanwhile stays.
  std::int64_t ring(Entry& entry, std::int64_t come) {
    std::int64_t due = entry.due.load(std::memory_order_acquire);
    while (due <= come) {
      if (entry.due.compare_exchange_strong(due, kNever, std::memory_order_acq_rel,
                                            std::memory_order_acquire)) {
        entry.wakeup->notify();
        return kNever;
      }
    }
    return due;
  }

  std::deque<Entry> entries_;
  Wakeup watch_;
};

using Alarms = BasicAlarms<FutexParker>;

}  // namespace armature::rt
