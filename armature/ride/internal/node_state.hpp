// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "armature/platform/sockets/poller.hpp"
#include "armature/platform/thread.hpp"
#include "armature/ride/internal/directory.hpp"
#include "armature/ride/internal/entrance.hpp"
#include "armature/ride/internal/handshakes.hpp"
#include "armature/ride/internal/journal.hpp"
#include "armature/ride/internal/link.hpp"
#include "armature/ride/internal/mailbox.hpp"
#include "armature/ride/internal/pending.hpp"
#include "armature/ride/node.hpp"

namespace armature::ride::internal {

class PeerState;
class Publisher;

/// A node's I/O thread and all that it looks after. Functions without a word about threads are
/// called by that thread only.
class NodeState final : public LinkHost {
 public:
  explicit NodeState(NodeOptions options);
  ~NodeState() override;

  const NodeOptions& options() const { return options_; }
  platform::Poller& poller() { return *poller_; }
  const std::shared_ptr<MemoryBound>& memory() const { return memory_; }
  Journal& journal() { return journal_; }
  Transport* find_transport(const std::string& scheme);
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

  base::Result<Address> listen(const std::string& text);
  base::Result<std::uint32_t> add(std::string name, Service& service);
  void remove(Service& service);
  Peer& connect(const std::string& address);
  /// @thread any
  NodeStatistics statistics() const;

  /// Looks after a connection that is there.
  std::shared_ptr<Link> adopt(std::unique_ptr<Connection> connection, const std::string& scheme);
  /// Has the timers looked at no later than then.
  void wake_at(base::Time time) { due_ = std::min(due_, time); }

  void count(std::uint64_t messages) override;
  void deliver(Link& link, const Message& message) override;
  void attend(Link& link) override;
  void flush_soon(Link& link) override;
  void return_soon(Link& link) override;
  void refused(const Link& link, Code code, const Message& message, std::string_view text) override;
  std::optional<Refusal> refusal_of(const Link& link, const Message& first,
                                    const std::string& identity) override;
  void event_dropped(const EventQueue& queue) override;

  /// Executes a message (internal/dispatch.cpp).
  void dispatch(Link& link, const Message& message);

 private:
  struct Hosted {
    std::uint32_t identifier;
    std::string name;
    std::uint32_t digest;
    Service* service;  ///< none once it was removed
  };
  struct Counters {
    std::atomic<std::uint64_t> connections_refused{0};
    std::atomic<std::uint64_t> messages{0};
    std::atomic<std::uint64_t> refusals{0};
    std::atomic<std::uint64_t> commands_failed{0};
    std::atomic<std::uint64_t> events_dropped{0};
    std::atomic<std::uint64_t> throttled{0};
    std::atomic<std::uint64_t> connections{0};
  };
  class SenderAt;
  /// How old gathered messages get.
  static constexpr base::Duration kFlushAge = std::chrono::microseconds(40);
  /// After so long without a call the node reads again what a caller has read.
  static constexpr base::Duration kLending = std::chrono::milliseconds(5);

  void run_loop();
  void take_ready(const platform::Ready& ready);
  void take_letters();
  void take_handed_over();
  void dispatch_pending();
  void dispatch_safely(Link& link, const Message& message);
  void dispatch_large(Link& link, const Message& message);
  void look_after_all();
  void wait_for_memory();
  void accept(Listener& listener);
  bool make_room();
  void send_away(const Connection& connection, const char* why);
  void tell_end(const std::string& who, bool was_established, std::string_view why);
  void bring_up(Link& link);
  void is_up(Link& link);
  void service_link(Link& link, const platform::Ready& ready);
  void receive(Link& link);
  void wait_for_turn(Link& link);
  void receive_of_greedy();
  void throttle(Link& link);
  base::Duration time_left();
  void look_at_clock();
  void look_after(Link& link);
  void let_go(Link& link);
  void end(Link& link);
  void forget_departed();
  void wake();
  void flush_gathered();
  void take_back_lent();
  void look_at_timers();
  void free_memory();
  void look_at_link(Link& link);
  void say_goodbye();
  base::Result<Address> listen_at(const Address& address);
  void warn_of_everyone(const Address& address);

  void execute(Link& link, const Message& message, bool is_request);
  void execute_directory(Link& link, const Message& message, Number operation, std::uint32_t call,
                         bool is_request, Decoder& parameters);
  void run_service(Link& link, const Message& message, Hosted& hosted, Number operation,
                   std::uint32_t call, bool is_request, Decoder& parameters, Holding& holding);
  void fail(Link& link, const Message& message, Hosted& hosted, Number operation,
            std::string_view what);
  std::optional<Refusal> refusal_of_operation(const Link& link, const Hosted& hosted,
                                              Number operation, const std::string& identity) const;
  std::string not_allowed(const AccessQuestion& question) const;
  bool is_allowed(const AccessQuestion& question) const;
  std::int32_t subscribe(Link& link, std::int32_t component, Number event,
                         std::int32_t subscription);
  std::int32_t refuse_subscription(const Link& link, Code code, std::string_view why);
  std::int32_t unsubscribe(Link& link, std::int32_t subscription);
  void take_control(Link& link, const Message& message);
  ComponentEntry entry_of(const Hosted& hosted) const;
  Hosted* find_hosted(std::uint32_t identifier);

  const NodeOptions options_;
  const std::shared_ptr<MemoryBound> memory_;
  Journal journal_;
  std::vector<std::shared_ptr<Transport>> transports_;
  std::unique_ptr<platform::Poller> poller_;
  std::mt19937 random_;
  /// Of `hosted_`: to change it, and to look at it in another thread.
  std::mutex hosted_mutex_;
  std::deque<Hosted> hosted_;
  Entrance entrance_;
  std::vector<std::shared_ptr<Link>> links_;     ///< those that others have made
  std::vector<std::shared_ptr<Link>> departed_;  ///< until all was dispatched that they have sent
  std::vector<std::unique_ptr<Peer>> peers_;
  std::vector<std::shared_ptr<Link>> flushed_;
  base::Time flush_at_ = base::Time::max();
  std::vector<std::shared_ptr<Link>> lent_;  ///< to callers
  base::Time return_at_ = base::Time::max();
  base::Time due_ = base::Time::max();
  base::Time large_from_{};  ///< if large messages are held
  base::Time now_{};         ///< when the clock was last looked at
  Pending pending_;
  std::size_t rounds_ = 0;
  bool dispatches_ = false;
  bool was_short_ = false;    ///< of memory, so that something was left undone
  std::deque<Link*> greedy_;  ///< who have sent much, and more; in the order of their turns
  Counters counters_;

  Mailbox mailbox_;
  std::atomic<bool> stopping_{false};
  Handshakes handshakes_;
  std::unique_ptr<platform::Thread> thread_;
};

}  // namespace armature::ride::internal
