// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "armature/base/time.hpp"
#include "armature/platform/thread.hpp"

namespace armature::platform {

/// From now on a reader of this program's output that goes away ends nothing: what is written for
/// it is lost and counted. Nor does a terminal stop the program that writes from the background,
/// and a file that may not grow any more (ulimit -f) is as a disk that is full.
void survive_lost_outputs();

/// Writes `text`, which is whole lines, to standard output or error, past the buffers of the C
/// library. Waits for whoever reads it, unless there is a `Printer`.
/// @param descriptor  `kStandardOutput` or `kStandardError`
/// @thread any
void print(int descriptor, std::string_view text);

/// Lines that `print` could not write since the start of the process: whoever reads is gone, or so
/// slow that no room was left.
/// @thread any
std::uint64_t lost_lines();

/// While it exists, `print` waits for nobody: a thread writes what was printed, in that order. A
/// terminal that blocks holds up that thread alone. One at a time.
class Printer {
 public:
  Printer();
  Printer(const Printer&) = delete;
  Printer& operator=(const Printer&) = delete;
  /// Gives what is left a second to be written.
  ~Printer();

  /// Waits until all that was printed is written; false if that takes longer than `limit`.
  static bool flush(base::Duration limit);

  struct State;

 private:
  std::shared_ptr<State> state_;
  std::unique_ptr<Thread> thread_;
};

}  // namespace armature::platform
