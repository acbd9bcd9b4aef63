// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::platform {

/// What became of a packet that was to be sent to another process.
enum class PacketSent { kYes, kFull, kGone };
/// What a look for the next packet found; kGone: the other end has closed.
enum class PacketReceived { kYes, kNothing, kGone };

/// One end of a connection to a process of this machine, which keeps packets whole and in their
/// order, and never waits. One thread may send while another receives and a third waits.
class PacketSocket {
 public:
  /// Connects to the socket file of a `PacketServer`; the error names it.
  static base::Result<std::unique_ptr<PacketSocket>> connect(const std::string& path);
  PacketSocket(const PacketSocket&) = delete;
  PacketSocket& operator=(const PacketSocket&) = delete;
  ~PacketSocket();

  /// One system call that does not wait.
  PacketSent send(std::span<const std::byte> packet);
  /// One system call that does not wait.
  /// @param size  of the packet; more than there is room for if the rest was cut off
  PacketReceived receive(std::span<std::byte> room, std::size_t& size);

  /// Connects to a server that has come since the one before went; false if there is none. What
  /// the other end had not received, and what waited here, is gone.
  /// A few system calls that do not wait.
  bool try_reconnect();

  /// Waits for packets that have not been waited for yet; false after `interrupt`.
  bool wait();
  /// Ends the present `wait` or `pause`, and every later one.
  void interrupt();
  /// Waits for a time; false after `interrupt`.
  bool pause(base::Duration time);
  /// Whether the other end has gone; packets that it sent may still be here.
  bool other_end_is_gone() const;
  /// Waits until a packet can be received; false if none came until then.
  bool wait_for_packet(base::Time deadline);

 private:
  PacketSocket(std::string path, int socket, int events, int interruption)
      : path_(std::move(path)), socket_(socket), events_(events), interruption_(interruption) {}

  const std::string path_;
  const int socket_;
  const int events_;
  const int interruption_;
};

/// The end that others connect to, at a socket file: a fixed number of places for clients, each
/// empty or taken. Who comes when all are taken is sent away.
/// @thread one at a time
class PacketServer {
 public:
  /// Makes the socket file, in place of one that a process left which is no more. The error names
  /// it: somebody else serves there, or it is no socket.
  static base::Result<std::unique_ptr<PacketServer>> listen(const std::string& path,
                                                            std::size_t places);
  PacketServer(const PacketServer&) = delete;
  PacketServer& operator=(const PacketServer&) = delete;
  /// Removes the socket file.
  ~PacketServer();

  std::size_t places() const { return clients_.size(); }
  bool taken(std::size_t place) const { return clients_[place] >= 0; }

  /// Gives the next client that waits a place; `places()` if there is no client, or no place.
  std::size_t accept();
  /// As those of PacketSocket.
  PacketSent send(std::size_t place, std::span<const std::byte> packet);
  PacketReceived receive(std::size_t place, std::span<std::byte> room, std::size_t& size);
  /// Ends the connection; the place is empty then.
  void drop(std::size_t place);
  /// Whether `wait_until` ends when a packet can be sent there that was `kFull`.
  void set_wants_to_send(std::size_t place, bool wants) { wants_to_send_[place] = wants; }

  /// Waits until a client comes, goes or sends, or until `deadline`.
  void wait_until(base::Time deadline);

 private:
  struct Polled;

  PacketServer(std::string path, int listener, std::size_t places);

  const std::string path_;
  const int listener_;
  std::vector<int> clients_;  ///< descriptors; -1: an empty place
  std::vector<bool> wants_to_send_;
  std::unique_ptr<Polled> polled_;
  base::Time accept_from_{};
};

}  // namespace armature::platform
