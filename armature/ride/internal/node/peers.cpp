// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/peers.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/peer_state.hpp"

namespace armature::ride::internal {

Peers::~Peers() {
  for (const auto& peer : peers_) peer->state()->detach();
}

Peer* Peers::find(const std::string& text) const {
  const auto known =
      std::ranges::find_if(peers_, [&](const auto& other) { return other->address() == text; });
  return known != peers_.end() ? known->get() : nullptr;
}

Peer& Peers::add(NodeState& node, const std::string& text, Transport* transport,
                 base::Result<Address> address) {
  peers_.push_back(std::make_unique<Peer>(std::make_shared<PeerState>(node, text)));
  peers_.back()->state()->start(transport, std::move(address));
  return *peers_.back();
}

void Peers::look_after_all() {
  for (const auto& peer : peers_) links_.look_after(peer->state()->link());
}

void Peers::look_at_timers() {
  for (const auto& peer : peers_) {
    reception_.look_at_timers(peer->state()->link());
    core_.clock.wake_at(peer->state()->look_at_timers(core_.clock.now()));
  }
}

void Peers::leave_all(const char* why) {
  for (const auto& peer : peers_) leave(peer->state()->link(), why);
}

void Peers::close_all(const char* why) {
  constexpr base::Duration kSoon = std::chrono::microseconds(20);
  for (const auto& peer : peers_) {
    // Whoever still reads has been told, and is on its way.
    while (!peer->state()->link().close()) platform::sleep_until(platform::monotonic_now() + kSoon);
    peer->state()->lost(why);
  }
}

}  // namespace armature::ride::internal
