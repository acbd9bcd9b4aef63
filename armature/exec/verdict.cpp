// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/verdict.hpp"

#include <algorithm>

#include "armature/platform/clock.hpp"
#include "armature/platform/process.hpp"

namespace armature::exec {

bool Verdict::complete() const {
  return std::all_of(lines.begin(), lines.end(),
                     [](const Line& line) { return line.refusals.empty(); });
}

std::string Verdict::to_text() const {
  std::string text;
  for (const Line& line : lines) {
    text += line.subject + ": asked for " + line.requested + ", got " + line.granted + "\n";
    for (const std::string& refusal : line.refusals) text += "  refused: " + refusal + "\n";
  }
  return text;
}

Verdict::Line kernel_line() {
  Verdict::Line line{"kernel", "PREEMPT_RT", "no preemption model named", {}};
  const std::string version = platform::kernel_version();
  for (const char* model : {"PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT"}) {
    if (version.find(model) == std::string::npos) continue;
    line.granted = model;
    break;
  }
  if (line.granted != line.requested) {
    line.refusals.push_back(
        "latencies have no bound on this kernel; install linux-image-rt-amd64 (Debian) or another "
        "kernel with PREEMPT_RT");
  }
  return line;
}

Verdict::Line clock_line() {
  constexpr base::Duration kFine = std::chrono::microseconds(1);
  const base::Duration resolution = platform::clock_resolution();
  Verdict::Line line{
      "clock", "a resolution of 1 us or better", std::to_string(resolution.count()) + " ns", {}};
  if (resolution > kFine) line.refusals.push_back("the kernel has no high-resolution timers");
  return line;
}

}  // namespace armature::exec
