// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"

namespace armature::platform {

/// Turns SIGINT, SIGTERM and SIGHUP into an orderly stop: the first sets a flag and ends `wait`.
/// The second SIGINT or SIGTERM ends the process at once with status 130. A SIGHUP that was ignored
/// before (nohup) stays so. One object at a time.
class StopSignal {
 public:
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  ~StopSignal();

  bool received() const;
  /// What came is heard: the next SIGINT or SIGTERM is the first again. A SIGHUP counts no more: a
  /// terminal that goes away answers nothing.
  void hear_next() const;
  /// Waits until the signal or `deadline`; true if the signal came.
  bool wait_until(base::Time deadline) const;
  /// Readable from the signal on, to be waited for beside others.
  int descriptor() const;
};

}  // namespace armature::platform
