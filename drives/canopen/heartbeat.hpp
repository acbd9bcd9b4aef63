// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "drives/canopen/cob_id.hpp"
#include "drives/canopen/nmt.hpp"

namespace armature::canopen {

/// The boot-up frame or heartbeat of a device.
/// @rt nonblocking, no allocation
can::Frame heartbeat_frame(NodeId node, NmtState state) noexcept;

/// What a heartbeat says; none if the frame is none, or of a state that CiA 301 does not have.
/// @rt nonblocking, no allocation
std::optional<NmtState> parse_heartbeat(const can::Frame& frame) noexcept;

/// Tells the bus at equal intervals that a device is there.
class HeartbeatProducer {
 public:
  explicit HeartbeatProducer(NodeId node) : node_(node) {}

  /// @param period  0: none are sent
  /// @rt nonblocking, no allocation
  void set_period(base::Duration period, base::Time now) noexcept;
  /// The heartbeat that is due, if any.
  /// @rt nonblocking, no allocation
  std::optional<can::Frame> step(NmtState state, base::Time now) noexcept;
  /// When the next one is due; the end of time if none is.
  base::Time next() const { return next_; }

 private:
  NodeId node_;
  base::Duration period_{};
  base::Time next_ = base::Time::max();
};

/// What is known of a device by its heartbeats.
enum class Presence : std::uint8_t {
  kAwaited,  ///< not yet heard; no timeout runs, as CiA 301 has it
  kPresent,
  kLost,  ///< heard, and then not in time
};
const char* to_text(Presence presence) noexcept;

/// Watches the heartbeats of devices.
class HeartbeatConsumer {
 public:
  struct Node {
    base::Duration timeout{};  ///< 0: not watched
    base::Time heard{};
    Presence presence = Presence::kAwaited;
    NmtState state = NmtState::kBootUp;
    std::uint32_t boot_ups = 0;  ///< how often it said that it has just started
  };

  /// @param timeout  between two heartbeats, above 0
  void watch(NodeId node, base::Duration timeout) { nodes_[node].timeout = timeout; }

  /// Does nothing with frames that are no heartbeat, or of a device that is not watched.
  /// @rt nonblocking, no allocation
  void take(const can::Frame& frame, base::Time time) noexcept;
  /// Finds those whose heartbeat is missing.
  /// @rt nonblocking, no allocation, O(127)
  void check(base::Time now) noexcept;

  /// @param node  0 to 127
  const Node& node(NodeId node) const { return nodes_[node]; }

 private:
  std::array<Node, kLastNode + 1> nodes_{};
};

}  // namespace armature::canopen
