// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::platform {

/// What a poller waits for; nothing: for none, and tells of none.
struct Interest {
  bool read = false;
  bool write = false;
  /// What can be read is told when it comes, not as long as it is there: for who takes all of it,
  /// which saves the kernel a look at each wait. `change` has it told anew. Not with `write`.
  bool news = false;
};

/// What can be done without waiting. A connection that has ended can be read and written.
struct Ready {
  std::uint64_t key;
  bool read;
  bool write;
  bool ended;  ///< the other side has ended the connection, or it broke
};

/// Waits for many descriptors at once, in one thread.
class Poller {
 public:
  static base::Result<std::unique_ptr<Poller>> make();
  Poller(const Poller&) = delete;
  Poller& operator=(const Poller&) = delete;
  ~Poller();

  /// Looks after `handle` from now on.
  /// @param key  what `wait` names it by
  /// @thread any
  bool add(int handle, std::uint64_t key, Interest interest);
  /// One system call.
  /// @thread any
  bool change(int handle, std::uint64_t key, Interest interest);
  /// Before the handle is closed.
  /// @thread any
  void remove(int handle);

  /// Waits until something is ready, `wake` was called or the time is over; `Duration::max()`:
  /// as long as it takes. Valid until the next call.
  /// @thread one at a time
  std::span<const Ready> wait(base::Duration limit);
  /// Ends the present `wait`, or the next. A system call only for the first of several.
  /// @thread any
  void wake();
  /// Ends the `wait` during which this time of the monotonic clock comes. A system call only if it
  /// is earlier than what was asked for before: so that waiting many times for data until a time
  /// far away arms and disarms no timer.
  /// @thread the one that waits
  void wake_at(base::Time time);
  /// Whether such a time has come during the last `wait`.
  bool time_has_come() const { return time_has_come_; }

 private:
  static constexpr std::size_t kMost = 64;

  Poller(int events, int alarm, int timer) : events_(events), alarm_(alarm), timer_(timer) {}

  const int events_;
  const int alarm_;
  const int timer_;
  base::Time rings_at_ = base::Time::max();
  bool time_has_come_ = false;
  std::atomic<bool> woken_{false};
  std::array<Ready, kMost> ready_{};
};

}  // namespace armature::platform
