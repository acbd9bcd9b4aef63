// SPDX-License-Identifier: Apache-2.0
// What a controller in the shadow costs the one that drives: cycles of the driving thread with and
// without it, in turns, in one process and in real time.
//
// usage: shadow_cost WITHOUT.yaml WITH.yaml THREAD LIBRARY_FOLDER [SECONDS_OF_EACH] [NAME=VALUE...]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "armature/deploy/deployment.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"

namespace {

using namespace armature;

/// Long enough for a median, short enough that what disturbs the machine disturbs both.
constexpr std::chrono::seconds kTurn{2};

/// One of the two, with the medians of its turns.
struct Side {
  const char* name;
  std::string file;
  std::vector<double> medians_us{};
  std::vector<double> means_us{};
  std::uint64_t cycles = 0;
  std::uint64_t skipped = 0;
};

deploy::Deployment load(const std::string& file, const std::string& libraries,
                        const std::vector<std::string>& overrides) {
  deploy::DeploymentOptions options;
  options.library_folders = {libraries};
  options.document.overrides = overrides;
  return deploy::load_deployment(file, options);
}

/// Between the bounds of its bucket, which are a quarter apart: by how many of the bucket are
/// below.
double median_ticks(const rt::DistributionSummary& cycles) {
  const double half = 0.5 * static_cast<double>(cycles.count);
  double below = 0.0;
  for (std::size_t i = 1; i < cycles.buckets.size(); ++i) {
    const auto here = static_cast<double>(cycles.buckets[i]);
    if (below + here >= half && here > 0.0) {
      const auto begin = static_cast<double>(rt::Distribution::upper_bound_of(i - 1));
      const auto end = static_cast<double>(rt::Distribution::upper_bound_of(i));
      return begin + (end - begin) * (half - below) / here;
    }
    below += here;
  }
  return static_cast<double>(cycles.most);
}

/// Runs it for a turn; false, and says why, if it does not run.
bool take_turn(Side& side, const std::string& thread, const std::string& libraries,
               const std::vector<std::string>& overrides) {
  deploy::Deployment deployment = load(side.file, libraries, overrides);
  if (!deployment.ok()) {
    std::fputs(deployment.diagnostics.to_text().c_str(), stderr);
    return false;
  }
  exec::ApplicationOptions options = std::move(deployment.options);
  options.realtime = exec::RealtimeMode::kPrefer;
  exec::Application application(std::move(deployment.blueprint), std::move(options));
  if (const auto started = application.start(); !started.ok()) {
    std::fputs(started.to_text().c_str(), stderr);
    return false;
  }
  application.run_for(kTurn);
  const auto all = application.thread_statistics();
  application.stop();
  const auto driving = std::ranges::find(all, thread, &exec::ThreadStatistics::name);
  if (driving == all.end()) {
    std::fprintf(stderr, "'%s' has no thread '%s'\n", side.file.c_str(), thread.c_str());
    return false;
  }
  const double tick_us = platform::tick_period_ns() * 1e-3;
  side.medians_us.push_back(median_ticks(driving->cycle_ticks) * tick_us);
  side.means_us.push_back(driving->cycle_ticks.mean() * tick_us);
  side.cycles += driving->cycles_run;
  side.skipped += driving->cycles_skipped;
  return true;
}

double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// The median of the ratios of neighbouring turns.
double ratio_of(const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<double> ratios;
  for (std::size_t turn = 0; turn < with.size(); ++turn)
    ratios.push_back(with[turn] / without[turn]);
  return median_of(std::move(ratios));
}

}  // namespace

int main(int count, char** words) {
  if (count < 5) {
    std::fputs(
        "usage: shadow_cost WITHOUT.yaml WITH.yaml THREAD LIBRARY_FOLDER [SECONDS_OF_EACH] "
        "[NAME=VALUE...]\n",
        stderr);
    return 2;
  }
  Side sides[] = {{"without the shadow", words[1], {}}, {"with the shadow", words[2], {}}};
  const std::string thread = words[3];
  const int seconds = count > 5 ? std::atoi(words[5]) : 60;
  const std::vector<std::string> overrides(words + std::min(count, 6), words + count);
  const int turns = std::max(1, seconds / static_cast<int>(kTurn.count()));
  for (int turn = 0; turn < turns; ++turn) {
    // Who comes first changes, too.
    for (int i = 0; i < 2; ++i) {
      if (!take_turn(sides[(turn + i) % 2], thread, words[4], overrides)) return 1;
    }
  }
  const double by_medians = ratio_of(sides[1].medians_us, sides[0].medians_us);
  const double by_means = ratio_of(sides[1].means_us, sides[0].means_us);
  for (const Side& side : sides) {
    std::printf(
        "%-18s  median cycle of %s %8.2f us, of %d turns of %d s; %llu cycles run, %llu skipped\n",
        side.name, thread.c_str(), median_of(side.medians_us), turns,
        static_cast<int>(kTurn.count()), static_cast<unsigned long long>(side.cycles),
        static_cast<unsigned long long>(side.skipped));
  }
  // Medians are no finer than a bucket where all cycles lie in one; means are exact, but disturbed.
  std::printf("the shadow costs %+.2f %% by medians, %+.2f %% by means (bound 2 %%)\n",
              100.0 * (by_medians - 1.0), 100.0 * (by_means - 1.0));
  return 0;
}
