// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

#include "armature/base/time.hpp"
#include "armature/ride/body.hpp"
#include "armature/ride/memory_share.hpp"
#include "armature/ride/transport.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride::internal {

/// What one connection is to be sent: messages one after the other, of which the other side has
/// taken the first bytes. Guarded by the link's lock.
class Outgoing {
 public:
  explicit Outgoing(MemoryShare* share) : bytes_(share) {}

  bool empty() const { return bytes_.empty(); }
  std::size_t unsent() const { return bytes_.size() - sent_; }

  /// Has `append(Body&)` put a message at the end: all of it or nothing.
  /// @return false if there is no memory for it
  template <typename Append>
  bool append(Priority priority, const Append& append) {
    const std::size_t start = bytes_.size();
    try {
      append(bytes_);
      most_urgent_ = std::max(most_urgent_, priority);
      return true;
    } catch (const std::bad_alloc&) {
      bytes_.truncate(start);
      bytes_.shrink(kMostKept);
      return false;
    }
  }
  /// The same with an event that was encoded before; the subscriber's identifier goes into the
  /// header of each part.
  bool append_event(std::uint32_t subscription, std::span<const std::byte> message);

  /// Whether what was appended now is to be sent at once, or waits for what follows.
  enum class Gather : std::uint8_t {
    kSend,
    kWait,
    kWaitAnew,  ///< nobody knows yet that something waits
  };
  Gather gather(base::Time now);
  /// Since when something has waited.
  base::Time gathered_since() const { return gathered_since_; }
  /// Nobody looks after what waits any more.
  void end_gathering() { gathers_ = false; }

  /// Sends what `connection` takes.
  /// @return kDone: it has taken all; kGone: it has ended; else it is blocked from now on
  Progress transmit(Connection& connection);
  /// The other side has not taken what was sent.
  bool blocked() const { return blocked_; }
  /// It may take something again.
  /// @return whether it was blocked
  bool unblock();
  /// Whether it has been blocked, and has taken nothing, for `limit`.
  bool is_stuck(base::Time now, base::Duration limit) const;

  void clear();

 private:
  /// What one large message took is given back.
  static constexpr std::size_t kMostKept = 256 * 1024;

  void forget_sent();
  void tell_level(Connection& connection);

  Body bytes_;
  Priority most_urgent_{};  ///< of what is to be sent
  int level_ = 0;           ///< that the connection was told
  std::size_t sent_ = 0;    ///< of `bytes_`
  bool blocked_ = false;
  base::Time stuck_since_{};  ///< if it is blocked: when it has taken something
  bool gathers_ = false;      ///< the I/O thread looks after what was gathered
  base::Time last_sent_{};
  base::Time gathered_since_{};
};

}  // namespace armature::ride::internal
