// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/foxglove/internal/channel_list.hpp"
#include "armature/foxglove/internal/outlet.hpp"
#include "armature/foxglove/internal/parameters.hpp"
#include "armature/foxglove/internal/subscriptions.hpp"
#include "armature/foxglove/server.hpp"
#include "armature/remote/peer_view.hpp"
#include "armature/ride/node.hpp"

namespace armature::foxglove::internal {

/// A client: what it is told of the application, and what it asks for.
/// @thread one
class Session {
 public:
  /// @param inside  its connection to the node of the application
  Session(websocket::Messages& messages, std::uint32_t client,
          std::unique_ptr<ride::Connection> inside, const ServerOptions& options);

  /// A message of the client.
  void take(bool text, std::string_view content);
  /// Tells what is new; some hundred times a second.
  /// @param now  of the monotonic clock
  void look(base::Time now);

 private:
  void answer(const Request& request);
  /// Looks whether the application is there, and another one than before.
  void follow();
  void describe(std::vector<inspect::ComponentStatus> components);
  std::vector<MovedRobot> robots(const std::vector<inspect::ComponentDescription>& components);
  base::Result<std::string> asset_at(const std::string& uri);
  void tell(const ChannelList::Change& change);
  void lose();
  void tell_losses();

  Outlet outlet_;
  ride::Node node_;
  ride::Peer& peer_;
  remote::PeerView view_;
  const std::unique_ptr<Companion> companion_;
  ChannelList channels_;
  Subscriptions subscriptions_;
  Parameters parameters_;
  std::vector<NamedRobot> robots_;

  bool there_ = false;                                ///< the application
  std::vector<inspect::ComponentStatus> components_;  ///< by which it is known again
  std::string told_refusal_;
  std::uint64_t told_lost_ = 0;
  base::Time next_values_{};
  base::Time next_texts_{};
  base::Time next_second_{};
  base::Time time_told_ = base::Time::min();
};

}  // namespace armature::foxglove::internal
