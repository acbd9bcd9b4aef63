// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "armature/exec/plan.hpp"

namespace armature::inspect {

/// Which end of an application leads to which.
struct Connection {
  std::string kind;       ///< `data`, `event`, `operation` or `command`
  std::string from;       ///< `Component.member`: an output, an event, or what is called
  std::string to;         ///< an input, a handler, or what does it
  bool triggers = false;  ///< data runs the input's handler
  bool delayed = false;   ///< data comes a cycle later
  bool crosses_threads = false;

  bool operator==(const Connection&) const = default;
};

/// Data first, in the order of the plan's; then events, then operations and commands.
/// @param which  components: connections of which both ends are among them
std::vector<Connection> connections_of(
    const exec::Plan& plan, const std::function<bool(const std::string& component)>& which);

/// The component of an end: what stands before the last dot.
std::string component_of_end(const std::string& end);

}  // namespace armature::inspect
