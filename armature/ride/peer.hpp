// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/address.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride {

namespace internal {
class PeerState;
struct RemoteComponent;
}  // namespace internal

/// Keeps a handler as long as it lives. Once it is destroyed the handler is not running and is not
/// called again; so do not destroy it with a lock held that the handler takes.
class [[nodiscard]] Subscription {
 public:
  Subscription() = default;
  explicit Subscription(std::function<void()> end) : end_(std::move(end)) {}
  Subscription(Subscription&& other) noexcept : end_(std::exchange(other.end_, nullptr)) {}
  Subscription& operator=(Subscription&& other) noexcept {
    std::swap(end_, other.end_);
    return *this;
  }
  ~Subscription() {
    if (end_) end_();
  }

 private:
  std::function<void()> end_;
};

/// What has become of the connection to a peer.
struct PeerChange {
  bool connected = false;
  std::string text;  ///< why it was lost, or who the other side says it is
};

/// What a directory says of a component.
struct PeerComponent {
  std::string name;
  std::string interface;  ///< the name of the one that it has
};

/// Another process, reached by a connection that comes back by itself. Made by Node::connect; lives
/// as long as the node.
class Peer {
 public:
  explicit Peer(std::shared_ptr<internal::PeerState> state);
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer();

  const std::string& address() const;
  /// True from the moment all components and subscriptions have been looked up.
  /// @thread any
  bool connected() const;
  /// Waits until it is connected; the error says what is in the way.
  /// @thread any but the node's own
  base::Result<void> wait_until_connected(base::Duration limit) const;
  /// The components that it hosts, as its directory lists them now; the error says what is in the
  /// way, also that no answer came within `limit`.
  /// @thread any but the node's own
  base::Result<std::vector<PeerComponent>> components(base::Duration limit) const;
  /// Calls `handler` at each loss and recovery, and when a component is there that was missing; by
  /// the node's I/O thread.
  Subscription on_change(std::function<void(const PeerChange&)> handler);
  /// How often the connection was lost.
  std::uint64_t losses() const;

  const std::shared_ptr<internal::PeerState>& state() const { return state_; }

 private:
  std::shared_ptr<internal::PeerState> state_;
};

}  // namespace armature::ride
