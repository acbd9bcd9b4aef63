// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/exec/application.hpp"

namespace armature::replay {

/// What changes in an application in simulated time, from one look at it to the next.
/// @thread the controlling one
class ChangedPorts {
 public:
  /// @param application  outlives it
  explicit ChangedPorts(const exec::Application& application);

  /// `PID1.Out = 0.5, Joint1.Position = 0.1`: output ports that have another value than at the last
  /// look, writers before readers; empty if none has. Long values are cut off.
  std::string look();

 private:
  struct Seen {
    std::string name;
    const component::OutputPortBase* port;
    std::uint64_t sequence = 0;
    std::string value;
  };
  std::vector<Seen> ports_;
};

}  // namespace armature::replay
