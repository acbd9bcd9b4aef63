// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/peers/peer.hpp"

namespace armature::benchmarks::peers {

std::vector<Peer> all_peers() {
  return {
      ride(),
#ifdef ARMATURE_PEER_OMNIORB
      omniorb(),
#endif
#ifdef ARMATURE_PEER_ICE
      ice(),
#endif
#ifdef ARMATURE_PEER_ZEROMQ
      zeromq(),
#endif
#ifdef ARMATURE_PEER_CYCLONEDDS
      cyclonedds(),
#endif
  };
}

}  // namespace armature::benchmarks::peers
