// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace armature::rt {

/// What the guard does about a call that does not belong on a real-time thread.
enum class GuardMode {
  kReport,  ///< prints each place once, soon, and a summary when the process ends
  kAbort,   ///< prints the first one and aborts the process there and then
  kCount,   ///< counts and keeps silent; `report` tells
};

/// The guard of this process: libarmature_guard.so, which stands in front of the C library. It is
/// there if the process was started with `guard_environment`, or if it was linked (tests).
class Guard {
 public:
  virtual void set_mode(GuardMode mode) = 0;
  /// Calls that did not belong on a real-time thread, since the start or `reset`.
  /// @thread any
  virtual std::uint64_t violations() const = 0;
  /// Each place once: the call, the component, the thread, how often, and the call stack.
  virtual std::string report() const = 0;
  /// Forgets all violations; to be called while no real-time thread runs.
  virtual void reset() = 0;

 protected:
  ~Guard() = default;
};

/// The guard of this process, nullptr if there is none.
Guard* loaded_guard();

/// Variables to add to the environment of a program so that the guard watches it from its start.
std::vector<std::pair<std::string, std::string>> guard_environment(GuardMode mode);

}  // namespace armature::rt
