// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/ride/address.hpp"
#include "armature/ride/internal/node/links.hpp"
#include "armature/ride/internal/node/node_core.hpp"
#include "armature/ride/internal/node/reception.hpp"
#include "armature/ride/peer.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride::internal {

class NodeState;

/// The nodes that a node connects to, one for each address, as long as it is there.
/// @thread the node's
class Peers {
 public:
  Peers(NodeCore& core, Links& links, Reception& reception)
      : core_(core), links_(links), reception_(reception) {}
  Peers(const Peers&) = delete;
  Peers& operator=(const Peers&) = delete;
  ~Peers();

  /// nullptr if there is none yet of this address.
  Peer* find(const std::string& text) const;
  /// @param transport  by which it is reached; none if the address has an error
  Peer& add(NodeState& node, const std::string& text, Transport* transport,
            base::Result<Address> address);

  void look_after_all();
  void look_at_timers();
  /// @param why  told to all
  void leave_all(const char* why);
  void close_all(const char* why);

 private:
  NodeCore& core_;
  Links& links_;
  Reception& reception_;
  std::vector<std::unique_ptr<Peer>> peers_;
};

}  // namespace armature::ride::internal
