// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a connection-oriented, reliable transport is to the protocol. A further one (as that of
// armature/tls) implements these three, passes armature/testing/transport_conformance.hpp, and is
// given to the node in its options.

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/address.hpp"

namespace armature::ride {

/// What became of an attempt that does not wait. kWantRead and kWantWrite: nothing yet; again when
/// the handle can be read or written.
enum class Progress { kDone, kWantRead, kWantWrite, kGone };

/// One end of a connection: bytes in their order, both ways.
/// @thread one may send while another receives; `shut_down` from any
class Connection {
 public:
  virtual ~Connection() = default;

  /// The descriptor that a poller watches.
  virtual int handle() const = 0;
  /// Brings the connection up: connecting, and whatever the transport does before data can flow.
  /// Called until it says kDone or kGone.
  virtual Progress establish() = 0;
  /// True if `establish` takes long to compute: the node has a thread of its own call it.
  virtual bool establishes_slowly() const { return false; }
  /// Sends as much as can be sent without waiting.
  /// @param sent  bytes taken
  /// @return kDone if at least one byte was taken
  virtual Progress send(std::span<const std::byte> bytes, std::size_t& sent) = 0;
  /// Receives what is there, without waiting. A transport may keep back what is left of 16 KiB that
  /// came together, and no poller tells of it: who watches the handle gives that much room.
  /// @return kDone if at least one byte was received
  virtual Progress receive(std::span<std::byte> room, std::size_t& size) = 0;
  /// True if a `receive` that leaves room has taken all that was there, and the handle tells when
  /// more comes. A transport that keeps bytes back, or leaves some in the kernel, says false.
  virtual bool takes_all() const { return false; }
  /// Like `receive`, but waits for it: kWantRead if nothing came within `limit` (> 0).
  virtual Progress wait_and_receive(std::span<std::byte> room, std::size_t& size,
                                    base::Duration limit) = 0;
  /// How urgent what is sent from now on is, for the system's queues: where there is something to
  /// set. Called when it is another level than before; 0 at first.
  /// @param level  0 to kMostUrgentLevel
  virtual void set_level([[maybe_unused]] int level) {}
  static constexpr int kMostUrgentLevel = 6;
  /// Ends the connection both ways, and whoever waits for it. The handle stays valid.
  virtual void shut_down() = 0;
  /// Who the other end is, for the log.
  virtual std::string other_end() const = 0;
  /// Who the other end has proven to be, without a space; empty where the transport proves nothing.
  virtual std::string identity() const { return {}; }
  /// Why it is gone.
  virtual std::string problem() const = 0;
  /// True if it is gone because the other side sends no more, and may still receive.
  virtual bool may_still_receive() const { return false; }
};

/// Where others connect to.
/// @thread one at a time
class Listener {
 public:
  virtual ~Listener() = default;
  virtual int handle() const = 0;
  /// The next connection that waits; none if there is none.
  virtual std::unique_ptr<Connection> accept() = 0;
  /// With the port that was got where any would do.
  virtual const Address& address() const = 0;
};

/// A way of carrying bytes between processes, such as TCP: listens and connects.
class Transport {
 public:
  virtual ~Transport() = default;
  /// The part of an address before the colon.
  virtual std::string scheme() const = 0;
  /// True if nobody but processes of this machine, or peers that prove who they are, can connect.
  virtual bool safe(const Address& address) const = 0;
  /// The address with a host that need not be asked for; may wait for a name service.
  virtual base::Result<Address> look_up(const Address& address) { return address; }
  /// @param address  as `look_up` gave it
  virtual base::Result<std::unique_ptr<Listener>> listen(const Address& address) = 0;
  /// Begins to connect; never waits.
  /// @param address  as `look_up` gave it
  virtual base::Result<std::unique_ptr<Connection>> connect(const Address& address) = 0;
};

/// Over TCP, without delay of small messages; only loopback addresses are safe.
std::unique_ptr<Transport> make_tcp_transport();
/// Over a socket file of this machine. The kernel says whose process connects: its identity is the
/// name of its account.
/// @param mode  of the socket file: who may write to it may connect
std::unique_ptr<Transport> make_unix_transport(unsigned mode = 0600);

}  // namespace armature::ride
