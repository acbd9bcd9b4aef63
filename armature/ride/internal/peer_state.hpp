// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "armature/ride/interface.hpp"
#include "armature/ride/internal/directory.hpp"
#include "armature/ride/internal/link.hpp"
#include "armature/ride/peer.hpp"

namespace armature::ride::internal {

class NodeState;

/// A component at a peer, as the directory there knows it.
struct RemoteComponent {
  enum class State { kUnknown, kFound, kMissing };

  std::string name;
  const Interface* interface = nullptr;
  std::atomic<std::uint32_t> identifier{0};  ///< 0: not known; changes with the link's lock held
  std::atomic<State> state{State::kUnknown};
};

/// What a Peer is: the connection that comes back, and what has to be made anew each time.
/// Functions without a word about threads are called by the I/O thread only.
class PeerState : public std::enable_shared_from_this<PeerState> {
 public:
  PeerState(NodeState& node, std::string text);

  /// @thread any
  const std::string& text() const { return text_; }
  Link& link() { return *link_; }
  const std::shared_ptr<Link>& shared_link() const { return link_; }
  bool connected() const { return connected_.load(std::memory_order_acquire); }
  std::uint64_t losses() const { return losses_.load(std::memory_order_relaxed); }
  base::Result<void> wait_until_connected(base::Duration limit) const;
  /// @thread any but the I/O thread
  base::Result<std::vector<PeerComponent>> components(base::Duration limit);
  Subscription on_change(std::function<void(const PeerChange&)> handler);
  std::shared_ptr<RemoteComponent> component(std::string name, const Interface& interface);
  Subscription subscribe(std::shared_ptr<RemoteComponent> component, Number event,
                         std::function<bool(Decoder&)> handler);
  void request(RemoteComponent& component, Number operation, const CallOptions& options,
               const Fields& parameters, WaitingCall& call);
  /// The node is no more.
  void detach();

  void start(Transport* transport, base::Result<Address> address);
  void connect(base::Time now);
  void established();
  void lost(const std::string& why);
  void take_event(const Message& message);
  void take_hello(std::string_view text);
  /// Whatever its time has come for.
  /// @return when it has to be called again
  base::Time look_at_timers(base::Time now);

 private:
  struct Handler {
    std::uint64_t id;
    std::function<bool(Decoder&)> call;
  };
  struct WireSubscription {
    std::uint32_t id;
    std::shared_ptr<RemoteComponent> component;
    Number event;
    std::vector<std::shared_ptr<Handler>> handlers;
    bool sent = false;
  };
  struct ChangeHandler {
    std::uint64_t id;
    std::function<void(const PeerChange&)> call;
  };

  void ask_whether_it_is_there();
  base::Time look_for_life(base::Time now);
  void look_up(const std::shared_ptr<RemoteComponent>& component);
  void found(const std::shared_ptr<RemoteComponent>& component, const ComponentEntry& entry);
  void set_state(RemoteComponent& component, RemoteComponent::State state);
  void send_subscription(WireSubscription& subscription);
  Subscription end_of(std::uint64_t handler);
  void unsubscribe(std::uint64_t handler);
  void remove_unused();
  void wait_until_looked_up(const RemoteComponent& component, base::Duration limit);
  void answered();
  void tell(const PeerChange& change);
  void set_problem(const std::string& problem);
  void try_later(base::Time now, const std::string& why);
  bool run(const std::function<void()>& task);
  void ask_the_directory(Number operation, const Fields& parameters, CallbackCall::Then then);

  NodeState* node_;
  const std::string text_;
  const std::shared_ptr<Link> link_;
  Transport* transport_ = nullptr;
  Address address_;
  std::uint32_t generation_ = 0;  ///< of the connection: an answer of one before is none
  std::size_t open_questions_ = 0;
  bool up_ = false;  ///< the connection is established
  base::Time connect_at_ = base::Time::max();
  base::Duration pause_{};
  base::Time ask_at_ = base::Time::max();
  base::Time heard_at_{};
  std::uint64_t heard_ = 0;
  int asked_ = 0;  ///< whether it lives, since it was heard
  base::Time ask_again_at_{};
  std::string greeting_;

  std::vector<std::shared_ptr<RemoteComponent>> components_;
  std::vector<std::unique_ptr<WireSubscription>> subscriptions_;
  bool delivering_ = false;  ///< so handlers that end stay in their places
  std::vector<std::shared_ptr<ChangeHandler>> change_handlers_;
  std::uint32_t last_subscription_ = 0;
  std::uint64_t last_handler_ = 0;

  std::atomic<bool> connected_{false};
  std::atomic<std::uint64_t> losses_{0};
  mutable std::mutex mutex_;  ///< of what follows, and of node_
  mutable std::condition_variable changed_;
  std::string problem_;
};

}  // namespace armature::ride::internal
