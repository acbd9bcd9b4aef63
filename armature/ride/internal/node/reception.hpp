// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "armature/ride/internal/link.hpp"
#include "armature/ride/internal/node/node_core.hpp"

namespace armature::ride::internal {

/// How a node reads its connections: those that send much take turns after all others, those that
/// send too much wait, and a message that has begun is to end in time.
/// @thread the node's
class Reception {
 public:
  explicit Reception(NodeCore& core) : core_(core) {}

  /// What there is to read, at once or when it is its turn.
  void read(Link& link);
  bool has_to_read() const { return !greedy_.empty(); }
  /// Of those who send much one is read in a round, last of all: what others have sent does not
  /// wait until all their floods have been read.
  void read_next();
  /// Looks whether it may be read again, and whether it is late.
  void look_at_timers(Link& link);
  /// Its connection has ended.
  void forget(Link& link);

 private:
  void receive(Link& link);
  void watch_incomplete(Link& link, std::optional<std::uint64_t> incomplete);
  void throttle(Link& link);

  NodeCore& core_;
  std::deque<Link*> greedy_;  ///< who have sent much, and more; in the order of their turns
};

}  // namespace armature::ride::internal
