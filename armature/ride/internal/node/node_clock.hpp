// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "armature/base/time.hpp"
#include "armature/platform/clock.hpp"

namespace armature::ride::internal {

/// What time it was when a node last looked, and when its timers are to be looked at. To ask what
/// time it is costs as much as a small message: it is done where it matters.
/// @thread the node's
class NodeClock {
 public:
  /// When it was last looked at.
  base::Time now() const { return now_; }
  base::Time look() { return now_ = platform::monotonic_now(); }

  /// Has the timers looked at no later than then.
  void wake_at(base::Time time) { due_ = std::min(due_, time); }
  base::Time due() const { return due_; }
  /// Whether the timers are to be looked at; they say when again.
  bool take_due() {
    if (now_ < due_) return false;
    due_ = base::Time::max();
    return true;
  }

 private:
  base::Time now_{};
  base::Time due_ = base::Time::max();
};

}  // namespace armature::ride::internal
