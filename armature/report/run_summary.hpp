// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"

namespace armature::report {

/// Its name in the folder of a run.
inline constexpr const char* kSummaryFile = "run.json";

/// What only the program knows that ran an application.
struct RunFacts {
  std::string deployment;  ///< its file
  bool simulated = false;
  base::Duration duration{};   ///< on the application's clock
  base::Duration wall_time{};  ///< on the machine's
  exec::RunEnd end = exec::RunEnd::kTimeUp;
  int exit_code = 0;
  std::vector<rt::LogRecord> complaints;  ///< warnings and errors that it logged
  std::size_t complaints_left_out = 0;
  std::vector<rt::LogRecord> moments;  ///< those that `moment_told_by` knows
  std::size_t moments_left_out = 0;
  std::uint64_t lines_lost = 0;  ///< of its output
  base::Time begin{};            ///< of the times of `complaints` and `moments`
};

/// Writes `run.json` into `folder`: how an application that has stopped fared, for the report and
/// for programs. Cycles and wake-ups of each thread, what the system granted, faults and who did
/// not get to the end, and every attribute that counts something and is not 0.
base::Result<void> write_run_summary(const std::string& folder, const RunFacts& facts,
                                     const exec::Application& application);

}  // namespace armature::report
