// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

/// What a picture of an application shows, however it is drawn.
namespace armature::analysis {

/// A component in the picture.
struct WiringNode {
  std::string name;
  std::string model;
  std::size_t thread;  ///< index into Wiring::threads
};

/// A connection, a subscription or the use of a peer.
struct WiringEdge {
  /// What flows along the edge.
  enum class Kind {
    kData,   ///< from output to input port
    kEvent,  ///< from who raises it to who handles it
    kPeer,   ///< from user to used, for each operation; without one, `from_port` is empty
  };
  Kind kind;
  std::size_t from;
  std::size_t to;
  std::string from_port;
  std::string to_port;
  bool triggers = false;
  bool delayed = false;
  std::string note;  ///< `fifo 8`, `one cycle later`; may be empty
  std::string type;  ///< of data: `double [rad]`
};

/// A thread and the components that run in it.
struct WiringThread {
  std::string name;
  std::string activity;  ///< `periodic 10 ms, priority 80`
  std::vector<std::size_t> nodes;
};

/// Everything that the picture shows.
struct Wiring {
  std::string application;
  std::vector<WiringThread> threads;
  std::vector<WiringNode> nodes;
  std::vector<WiringEdge> edges;
};

Wiring make_wiring(const exec::Blueprint& blueprint, const exec::Plan& plan);

}  // namespace armature::analysis
