// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/run_options.hpp"

#include <chrono>
#include <cstdint>

#include "armature/base/unit.hpp"
#include "armature/record/black_box_file.hpp"

namespace armature::runner {

/// Short enough to be added to any time.
base::Duration RunOptions::longest() const {
  return duration.value_or(std::chrono::hours(24 * 365 * 100));
}

std::optional<base::Duration> parse_duration(std::string_view text) {
  const auto quantity = base::parse_quantity(text);
  if (!quantity) return std::nullopt;
  const std::string unit = quantity.value().unit.empty() ? "s" : quantity.value().unit;
  const auto ns = base::convert(quantity.value().value, unit, "ns");
  constexpr double kLongest = 9.0e18;
  if (!ns || !(ns.value() >= 1.0 && ns.value() < kLongest)) return std::nullopt;
  return base::Duration(static_cast<std::int64_t>(ns.value()));
}

void apply(const RunOptions& run, exec::ApplicationOptions& options) {
  options.simulated = run.simulated;
  options.pace.rate = run.rate;
  options.realtime = run.simulated ? exec::RealtimeMode::kOff : run.realtime;
  options.output_folder = run.output_folder;
  options.black_box.write = [folder = run.output_folder](const exec::BlackBoxReport& report) {
    return record::say_written(report, folder);
  };
}

}  // namespace armature::runner
