// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/address.hpp"
#include "armature/ride/interface.hpp"
#include "armature/ride/peer.hpp"
#include "armature/ride/service.hpp"
#include "armature/ride/transport.hpp"
#include "armature/rt/log.hpp"

namespace armature::ride {

/// What one connection, and all together, may take of a node.
struct Limits {
  /// Accepted ones. Who comes later takes the place of one whose handshake is not done, or is sent
  /// away.
  std::size_t connections = 64;
  /// Accepted ones, a tenth of them at once. Others wait with the operating system.
  std::uint32_t connections_per_second = 500;
  std::size_t body_bytes = 16 * 1024 * 1024;  ///< of one message, all its parts together
  /// That all peers together may make the node keep: bodies, values, what is not taken, events,
  /// subscriptions. 256 KiB of it are each connection's own; of the others it gets so much that as
  /// many again find some left. Beyond, requests are refused: BUSY; events are dropped.
  std::size_t memory_bytes = 64 * 1000 * 1000;
  /// Of one connection. Beyond, it is not read until the second is over; nothing is lost.
  std::uint64_t messages_per_second = 20'000'000;
  base::Duration time_to_complete = std::chrono::seconds(5);  ///< a message that has begun
  std::size_t pending_replies = 256;  ///< of one connection; further requests are refused: BUSY
  std::size_t subscriptions = 1024;   ///< of one connection
  std::size_t subscriptions_to_an_event = 4;  ///< of one connection: each is sent the same again
  std::size_t events_per_subscription = 64;   ///< that wait to be sent; the oldest is dropped
  /// Of one connection, that the other side has not taken. Beyond, a command is kQueueFull, and who
  /// does not take its answers is not read until it does.
  std::size_t unsent_bytes = 1024 * 1024;
};

/// How a peer comes back.
struct Reconnection {
  base::Duration first = std::chrono::milliseconds(20);
  base::Duration most = std::chrono::seconds(2);
  double factor = 2.0;
  double jitter = 0.25;  ///< the pause is up to this part of it shorter or longer
  /// A connection that is silent so long is asked whether it lives, and is lost after three times
  /// as long; 0: never.
  base::Duration silence = std::chrono::seconds(1);
};

/// Real-time priorities (SCHED_FIFO, 1 to 99) of a node's thread, by the priority of the message
/// that it serves; none by default.
struct ServingPriorities {
  int most = 0;   ///< while it waits, and for a message of priority 255; 0: not in real time
  int least = 0;  ///< for a message of priority 0, at least 1

  /// Those between have their share.
  constexpr int of(Priority message) const {
    if (most == 0) return 0;
    return least + (most - least) * message.level / 255;
  }
};

/// Who wants to use what, for NodeOptions::allows.
struct AccessQuestion {
  std::string_view transport;  ///< the scheme of its address
  std::string_view identity;   ///< what it has proven to be; empty if nothing
  std::string_view component;
  Access access;
};

/// Who asks, as policies and logs say it: `operator@tls` for an identity and the transport that has
/// proven it, `page@web` for a page over `ws`, `local:pilot` for a process of this machine whose
/// account the kernel vouches for, `local` for one that proves nothing.
std::string who(const AccessQuestion& question);

/// How a node works, what it allows and where it reports to.
struct NodeOptions {
  std::string name = "node";
  Limits limits;
  Reconnection reconnection;
  /// Every refusal, loss and failure; called by the I/O thread or the one that found it. A kind of
  /// message is told at most ten times a second; the rest is counted. It must not call ride back.
  std::function<void(const rt::LogRecord&)> log;
  /// Who may do what; without, everyone may do everything. Called by the I/O thread and those that
  /// wait for an answer, one at a time for each connection.
  std::function<bool(const AccessQuestion&)> allows;
  /// Of its thread. What the system refuses is logged, and the node works without.
  ServingPriorities serving;
  /// Permissions of the socket files that it listens at: who may write may connect.
  unsigned socket_mode = 0600;
  /// Beside TCP and Unix-domain sockets.
  std::vector<std::shared_ptr<Transport>> transports;
};

/// What a node has done and refused since it began.
struct NodeStatistics {
  std::uint64_t connections = 0;          ///< accepted ones that are there now
  std::uint64_t connections_refused = 0;  ///< too many, or their handshake failed
  std::uint64_t messages = 0;             ///< received, of all types
  std::uint64_t refusals = 0;             ///< CONTROL messages sent because of a message at fault
  std::uint64_t commands_failed = 0;
  std::uint64_t events_dropped = 0;  ///< oldest of a subscription whose queue was full
  std::uint64_t throttled = 0;       ///< times that a connection was too fast
  std::uint64_t memory_bytes = 0;    ///< of Limits::memory_bytes, in use now
};

namespace internal {
class NodeState;
}

/// A process's endpoint: hosts components, listens on any number of transports and connects to
/// other nodes, all with one thread.
class Node {
 public:
  explicit Node(NodeOptions options = {});
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  /// Tells everyone that it shuts down, fails what is open, and ends its thread.
  ~Node();

  /// Listens at `address`, such as "tcp://127.0.0.1:0" or "unix:/run/robot.sock".
  /// @return the address with the port that was got; the error says what is in the way. Addresses
  ///   that other machines reach are refused where the transport does not prove who connects, or
  ///   without NodeOptions::allows
  base::Result<Address> listen(const std::string& address);

  /// Hosts `service` as `name`.
  /// @return its identifier, >= 1, never given again; the error: the name is taken
  base::Result<std::uint32_t> add(std::string name, Service& service);
  /// No more. Once it returns nothing of the service is executed any more.
  void remove(Service& service);

  /// The process that listens at `address`; the same Peer for the same address. Returns at once:
  /// what is in the way (a wrong address, too) is logged and told by Peer::wait_until_connected.
  Peer& connect(const std::string& address);

  NodeStatistics statistics() const;

 private:
  std::shared_ptr<internal::NodeState> state_;
};

}  // namespace armature::ride
