// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"
#include "armature/platform/sockets/packet_socket.hpp"

namespace armature::can {

/// Lets other processes of this machine take part in a virtual bus: each that connects to the
/// socket file by a `SharedBus` has a station, until it closes or dies, which leaves the station
/// silent. The thread that advances the bus, in real time, does
///
///     while (going) {
///       server.take();
///       bus.advance_to(platform::monotonic_now());
///       server.give();
///       server.wait_until(bus.next_event().value_or(...));
///     }
///
/// Whatever a client does, the server takes bounded time and memory for it: packets that are none
/// end its connection, what does not fit is counted as lost, who comes when all stations are taken
/// is sent away. Between packets of a client that floods it the bus goes on.
class BusServer {
 public:
  static constexpr std::size_t kMostClients = 16;

  /// nullptr after an error, named in `diagnostics`.
  /// @param bus  on the monotonic clock; gets `kMostClients` stations more, and outlives the server
  /// @param path  of the socket file; who may write to that may take part
  static std::unique_ptr<BusServer> open(VirtualBus& bus, const std::string& path,
                                         base::Diagnostics& diagnostics);
  BusServer(const BusServer&) = delete;
  BusServer& operator=(const BusServer&) = delete;
  ~BusServer();

  /// Clients come and go, and what they have sent is sent on the bus; never waits.
  void take();
  /// What came for them on the bus is theirs; never waits.
  void give();
  /// Waits until `take` has something to do, or until `deadline`.
  void wait_until(base::Time deadline);

  std::size_t clients() const;
  /// Clients that were sent away because of what they sent, or because they said nothing.
  std::uint64_t sent_away() const { return sent_away_; }

 private:
  struct Client;

  BusServer(VirtualBus& bus, std::unique_ptr<platform::PacketServer> socket);
  void accept_clients();
  void take_from(std::size_t place);
  bool take_packet(std::size_t place, std::size_t size);
  bool welcome(std::size_t place, std::size_t size);
  void give_to(std::size_t place);
  bool send_status(std::size_t place);
  void drop(std::size_t place);
  void send_away(std::size_t place);

  std::unique_ptr<platform::PacketServer> socket_;
  std::vector<std::unique_ptr<Client>> clients_;
  std::vector<std::byte> room_;  ///< for the largest packet
  std::uint64_t sent_away_ = 0;
};

}  // namespace armature::can
