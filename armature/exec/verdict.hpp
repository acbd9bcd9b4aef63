// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace armature::exec {

/// What was asked of the operating system and what was granted, before anything moves.
struct Verdict {
  /// What one thread, or the process as a whole, asked for and got.
  struct Line {
    std::string subject;  ///< a thread's name, or `memory`, `kernel`
    std::string requested;
    std::string granted;
    std::vector<std::string> refusals;  ///< why not, and how to get it
  };
  std::vector<Line> lines;

  bool complete() const;
  std::string to_text() const;
};

/// Whether the kernel bounds latencies (PREEMPT_RT), and whether its clock is fit for control.
Verdict::Line kernel_line();
Verdict::Line clock_line();

}  // namespace armature::exec
