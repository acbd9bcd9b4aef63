// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/heartbeat.hpp"

namespace armature::canopen {

can::Frame heartbeat_frame(NodeId node, NmtState state) noexcept {
  return can::data_frame(cob_id::heartbeat(node), {static_cast<std::uint8_t>(state)});
}

std::optional<NmtState> parse_heartbeat(const can::Frame& frame) noexcept {
  if (origin_of(frame).service != Service::kHeartbeat || frame.size != 1) return std::nullopt;
  // The highest bit is the toggle of node guarding, which is no heartbeat.
  if (!is_nmt_state(frame.data[0])) return std::nullopt;
  return static_cast<NmtState>(frame.data[0]);
}

void HeartbeatProducer::set_period(base::Duration period, base::Time now) noexcept {
  period_ = period;
  next_ = period > base::Duration{} ? base::later(now, period) : base::Time::max();
}

std::optional<can::Frame> HeartbeatProducer::step(NmtState state, base::Time now) noexcept {
  if (now < next_) return std::nullopt;
  next_ += period_;
  if (next_ <= now) next_ = base::later(now, period_);  // after a pause one is enough
  return heartbeat_frame(node_, state);
}

const char* to_text(Presence presence) noexcept {
  switch (presence) {
    case Presence::kAwaited:
      return "awaited";
    case Presence::kPresent:
      return "present";
    case Presence::kLost:
      return "lost";
  }
  return "unknown";
}

void HeartbeatConsumer::take(const can::Frame& frame, base::Time time) noexcept {
  const std::optional<NmtState> state = parse_heartbeat(frame);
  if (!state) return;
  Node& node = nodes_[frame.id & kLastNode];
  if (node.timeout <= base::Duration{}) return;
  node.heard = time;
  node.presence = Presence::kPresent;
  node.state = *state;
  if (*state == NmtState::kBootUp) ++node.boot_ups;
}

void HeartbeatConsumer::check(base::Time now) noexcept {
  for (Node& node : nodes_) {
    if (node.presence == Presence::kPresent && now > base::later(node.heard, node.timeout)) {
      node.presence = Presence::kLost;
    }
  }
}

}  // namespace armature::canopen
