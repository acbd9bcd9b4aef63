// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/platform/own_priority.hpp"
#include "armature/ride/node.hpp"

namespace armature::ride::internal {

/// As long as it lives the node's thread has the real-time priority of the message that it serves.
/// It waits with the greatest one: what is urgent is to be noticed.
/// @thread the node's
class Serving {
 public:
  Serving(const ServingPriorities& priorities, Priority message)
      : waits_with_(priorities.of({255})), serves_with_(priorities.of(message)) {
    if (serves_with_ != waits_with_) static_cast<void>(platform::set_own_priority(serves_with_));
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;
  ~Serving() {
    if (serves_with_ != waits_with_) static_cast<void>(platform::set_own_priority(waits_with_));
  }

 private:
  const int waits_with_;
  const int serves_with_;
};

}  // namespace armature::ride::internal
