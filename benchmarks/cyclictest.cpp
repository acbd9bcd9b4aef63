// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/cyclictest.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "armature/platform/clock.hpp"
#include "armature/platform/thread.hpp"

namespace armature::benchmarks {
namespace {

constexpr long kHistogram = 1'000'000;  // of cyclictest at most [ns]

/// Takes a line of cyclictest's histogram, or what it says of those that were later.
void take(const char* line, std::vector<double>& latencies) {
  static constexpr const char kMost[] = "# Max Latencies: ";
  static constexpr const char kLater[] = "# Histogram Overflows: ";
  static double most = 0.0;
  const std::string text = line;
  long latency = 0;
  long count = 0;
  if (text.rfind(kMost, 0) == 0) most = std::strtod(line + sizeof kMost - 1, nullptr);
  if (text.rfind(kLater, 0) == 0) {
    latencies.insert(latencies.end(), std::strtoul(line + sizeof kLater - 1, nullptr, 10), most);
  }
  if (std::sscanf(line, "%ld %ld", &latency, &count) != 2 || count == 0) return;
  latencies.insert(latencies.end(), static_cast<std::size_t>(count), static_cast<double>(latency));
}

std::string command_for(base::Duration period, base::Duration duration, int priority) {
  std::string command = "cyclictest --quiet --mlockall --nsecs --threads=1";
  command += " --interval=" + std::to_string(period / std::chrono::microseconds(1));
  command += " --loops=" + std::to_string(duration / period);
  command += " --histogram=" + std::to_string(kHistogram);
  command += priority > 0 ? " --policy=fifo --priority=" + std::to_string(priority)
                          : std::string(" --policy=other");
  return command + " 2>/dev/null";
}

}  // namespace

bool cyclictest_runs(int priority) {
  constexpr base::Duration kPeriod = std::chrono::milliseconds(1);
  try {
    return !run_cyclictest(kPeriod, 10 * kPeriod, priority).empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

std::vector<double> run_cyclictest(base::Duration period, base::Duration duration, int priority) {
  const std::string command = command_for(period, duration, priority);
  std::FILE* const output = popen(command.c_str(), "r");
  if (output == nullptr) throw std::runtime_error("cannot start: " + command);
  std::vector<double> latencies;
  char line[256];
  while (std::fgets(line, sizeof line, output) != nullptr) take(line, latencies);
  if (pclose(output) != 0 || latencies.empty()) throw std::runtime_error("failed: " + command);
  std::sort(latencies.begin(), latencies.end());
  return latencies;
}

std::vector<double> run_sleeping_loop(base::Duration period, base::Duration duration,
                                      int priority) {
  const auto cycles = static_cast<std::size_t>(duration / period);
  std::vector<double> latencies(cycles);
  platform::ThreadRequest request;
  request.name = "reference";
  request.scheduler = priority > 0 ? platform::Scheduler::kFifo : platform::Scheduler::kOther;
  request.priority = priority;
  platform::Thread thread(request, [&] {
    base::Time due = platform::monotonic_now();
    for (double& latency : latencies) {
      due += period;
      platform::sleep_until(due);
      latency = static_cast<double>((platform::monotonic_now() - due).count());
    }
  });
  thread.join();
  std::sort(latencies.begin(), latencies.end());
  return latencies;
}

}  // namespace armature::benchmarks
