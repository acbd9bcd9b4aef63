// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/internal/entrance.hpp"
#include "armature/ride/internal/handshakes.hpp"
#include "armature/ride/internal/link.hpp"
#include "armature/ride/internal/node/hosted_services.hpp"
#include "armature/ride/internal/node/node_core.hpp"
#include "armature/ride/internal/node/reception.hpp"

namespace armature::ride::internal {

/// A node's connections from their coming to their end: those that others have made are kept here,
/// those of peers only brought up and attended to.
/// @thread the node's
class Links {
 public:
  /// @param host  of the links
  Links(NodeCore& core, LinkHost& host, const HostedServices& services, Reception& reception);

  /// From now on others come in there.
  const Address& listen(std::unique_ptr<Listener> listener);
  /// Looks after a connection that is there; nullptr if there is no memory for it.
  std::shared_ptr<Link> adopt(std::unique_ptr<Connection> connection, const std::string& scheme);
  std::size_t size() const { return links_.size(); }

  /// Something came, can be sent or has ended: at a listener or a link of any kind.
  void take_ready(const platform::Ready& ready);
  /// Goes on with those whose handshakes were computed.
  void take_handshakes() { handshakes_.take_done(); }
  /// A connection may have ended.
  void look_after(Link& link);
  void look_after_all();
  void look_at_timers();
  /// Forgets those that have ended, once all was dispatched that they have sent.
  void forget_departed();

  /// A component is no more.
  void end_events_of(std::uint32_t component);

  /// No handshake goes on.
  void stop_handshakes() { handshakes_.stop(); }
  /// @param why  told to all
  void leave_all(const char* why);
  void close_all();
  void forget_all();

 private:
  void accept(Listener& listener);
  bool make_room();
  void send_away(const Connection& connection, const char* why);
  void serve(Link& link, const platform::Ready& ready);
  void bring_up(Link& link);
  void is_up(Link& link);
  void free_memory();
  void tell_end(const std::string& who, bool was_established, std::string_view why);
  void end(Link& link);

  NodeCore& core_;
  LinkHost& host_;
  const HostedServices& services_;
  Reception& reception_;
  Entrance entrance_;
  std::vector<std::shared_ptr<Link>> links_;     ///< those that others have made
  std::vector<std::shared_ptr<Link>> departed_;  ///< until all was dispatched that they have sent
  Handshakes handshakes_;
};

/// Tells the other side and breaks off.
void leave(Link& link, const char* why);

}  // namespace armature::ride::internal
