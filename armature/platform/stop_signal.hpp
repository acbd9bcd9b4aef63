// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"

namespace armature::platform {

/// Turns SIGINT and SIGTERM into an orderly stop: the first sets a flag and ends `wait`, the second
/// ends the process at once with status 130. One object at a time.
class StopSignal {
 public:
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  ~StopSignal();

  bool received() const;
  /// Waits until the signal or `deadline`; true if the signal came.
  bool wait_until(base::Time deadline) const;
};

}  // namespace armature::platform
