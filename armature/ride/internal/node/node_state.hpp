// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "armature/platform/sockets/poller.hpp"
#include "armature/platform/thread.hpp"
#include "armature/ride/internal/link.hpp"
#include "armature/ride/internal/mailbox.hpp"
#include "armature/ride/internal/node/access_control.hpp"
#include "armature/ride/internal/node/dispatcher.hpp"
#include "armature/ride/internal/node/hosted_services.hpp"
#include "armature/ride/internal/node/link_rounds.hpp"
#include "armature/ride/internal/node/links.hpp"
#include "armature/ride/internal/node/node_core.hpp"
#include "armature/ride/internal/node/peers.hpp"
#include "armature/ride/internal/node/reception.hpp"
#include "armature/ride/internal/node/transports.hpp"
#include "armature/ride/internal/node/turns.hpp"
#include "armature/ride/node.hpp"

namespace armature::ride::internal {

/// A node's I/O thread and the rounds that it makes through all that it looks after. Functions
/// without a word about threads are called by that thread only.
class NodeState final : public LinkHost {
 public:
  explicit NodeState(NodeOptions options);

  const NodeOptions& options() const { return core_.options; }
  platform::Poller& poller() { return *core_.poller; }
  const std::shared_ptr<MemoryBound>& memory() const { return core_.memory; }
  Journal& journal() { return core_.journal; }
  Transport* find_transport(const std::string& scheme) { return transports_.find(scheme); }
  std::mt19937& random() { return random_; }

  /// Begins; without its thread if a test drives it by `step`.
  void start();
  /// Tells everyone and ends the thread.
  /// @thread the node's owner
  void stop();
  bool in_io_thread() const;
  /// Has the I/O thread do it; returns when it is done.
  /// @thread any
  void run(const std::function<void()>& task);
  /// The same without waiting.
  /// @thread any
  void post(std::function<void()> task);
  /// One round: waits at most until `limit` has passed, receives, dispatches.
  void step(base::Duration limit);

  /// @thread any
  base::Result<Address> listen(const std::string& text);
  base::Result<std::uint32_t> add(std::string name, Service& service);
  void remove(Service& service);
  Peer& connect(const std::string& address);
  NodeStatistics statistics() const;

  /// Looks after a connection that is there.
  std::shared_ptr<Link> adopt(std::unique_ptr<Connection> connection, const std::string& scheme) {
    return links_.adopt(std::move(connection), scheme);
  }
  /// Has the timers looked at no later than then.
  void wake_at(base::Time time) { core_.clock.wake_at(time); }

  void count(std::uint64_t messages) override;
  void deliver(Link& link, const Message& message) override;
  void attend(Link& link) override;
  void flush_soon(Link& link) override;
  void return_soon(Link& link) override;
  void refused(const Link& link, Code code, const Message& message, std::string_view text) override;
  std::optional<Refusal> refusal_of(const Link& link, const Message& first,
                                    const std::string& identity) override;
  void event_dropped(const EventQueue& queue) override;

 private:
  /// How old gathered messages get.
  static constexpr base::Duration kFlushAge = std::chrono::microseconds(40);
  /// After so long without a call the node reads again what a caller has read.
  static constexpr base::Duration kLending = std::chrono::milliseconds(5);

  void run_loop();
  void wait_for_memory();
  void wake();
  void take_handed_over();
  void take_letters();
  base::Duration time_left();
  void look_at_clock();
  void say_goodbye();
  void warn_of_everyone(const Address& address);

  NodeCore core_;
  const Transports transports_;
  const AccessControl access_;
  HostedServices services_;
  Dispatcher dispatcher_;
  Turns turns_;
  Reception reception_;
  Links links_;
  Peers peers_;
  LinkRounds flushes_;  ///< of those that have gathered messages
  LinkRounds returns_;  ///< of those that callers read
  std::mt19937 random_;
  std::size_t rounds_ = 0;
  bool was_short_ = false;  ///< of memory, so that something was left undone
  Mailbox mailbox_;
  std::atomic<bool> stopping_{false};
  std::unique_ptr<platform::Thread> thread_;
};

}  // namespace armature::ride::internal
