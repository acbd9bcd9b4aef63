// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/analysis/wiring_graph.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

/// What a picture of an application shows, however it is drawn.
namespace armature::analysis {

/// A component in the picture.
struct WiringNode {
  std::string name;    ///< of several `Joint1..7`
  std::string model;   ///< of several `7 x Joint`
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
  /// As `text_of` has them, if it stands for several; else empty.
  std::vector<std::string> bundled = {};
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

/// `Joint1.Out → Mux.Position1, double [rad], triggers`.
std::string text_of(const Wiring& wiring, const WiringEdge& edge);

/// Only these components and those that something joins to one of them, with what joins them.
Wiring selection_of(const Wiring& wiring, const std::vector<std::string>& names);

/// One node for components of one model and thread whose names differ by the number at their end,
/// and one edge for all of one kind from one node to another.
Wiring bundled(const Wiring& wiring);

/// All of it, each connection by itself.
Wiring make_wiring(const exec::Blueprint& blueprint, const exec::Plan& plan);

/// What a picture with these options shows.
Wiring make_wiring(const exec::Blueprint& blueprint, const exec::Plan& plan,
                   const GraphOptions& options);

}  // namespace armature::analysis
