// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/internal/journal.hpp"
#include "armature/ride/internal/node/node_clock.hpp"
#include "armature/ride/memory_share.hpp"
#include "armature/ride/node.hpp"

namespace armature::ride::internal {

/// What a node has done and refused since it began.
/// @thread any
class Counters {
 public:
  using Counter = std::atomic<std::uint64_t>;

  static void increase(Counter& counter, std::uint64_t by = 1) {
    counter.fetch_add(by, std::memory_order_relaxed);
  }
  NodeStatistics statistics(std::uint64_t memory_bytes) const;

  Counter connections{0};
  Counter connections_refused{0};
  Counter messages{0};
  Counter refusals{0};
  Counter commands_failed{0};
  Counter events_dropped{0};
  Counter throttled{0};
};

/// What all parts of a node have in common.
struct NodeCore {
  /// Throws std::runtime_error if the system has no poller to give.
  explicit NodeCore(NodeOptions given);

  const NodeOptions options;
  const std::shared_ptr<MemoryBound> memory;
  Journal journal;
  Counters counters;
  const std::unique_ptr<platform::Poller> poller;
  NodeClock clock;
};

}  // namespace armature::ride::internal
