// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "armature/base/time.hpp"
#include "armature/exec/application_options.hpp"

namespace armature::runner {

/// How an application is to be run, as the command line says it.
struct RunOptions {
  bool simulated = false;
  double rate = exec::kAsFastAsPossible;  ///< of simulated time
  std::optional<base::Duration> duration;
  exec::RealtimeMode realtime = exec::RealtimeMode::kPrefer;
  std::string output_folder;  ///< of recordings; empty: the working directory
  bool statistics = false;

  bool urges() const { return !simulated && realtime != exec::RealtimeMode::kOff; }
  /// How long it runs; without a duration long enough to be "until stopped".
  base::Duration longest() const;
};

/// `10s`, `250 ms`: a time above 0, or nothing.
std::optional<base::Duration> parse_duration(std::string_view text);

/// Gives `options` what the command line says of a run, and where black boxes go.
void apply(const RunOptions& run, exec::ApplicationOptions& options);

}  // namespace armature::runner
