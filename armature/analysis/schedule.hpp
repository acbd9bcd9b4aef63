// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::analysis {

/// Execution time of one cycle.
struct ExecutionTime {
  std::uint64_t cycles = 0;  ///< how many were measured
  base::Duration p999{};     ///< 99.9 % took at most this
  base::Duration most{};
};

/// Measured execution times by name, as `armature run --times FILE` writes them.
struct ExecutionTimes {
  std::string application;
  std::map<std::string, ExecutionTime, std::less<>> threads;  ///< whole cycles
  std::map<std::string, ExecutionTime, std::less<>>
      components;  ///< own time, without what it calls
};

/// What was measured since the start of `application`.
ExecutionTimes measured_times(const exec::Application& application);

/// The file of execution times: YAML, `threads: {Sampler: {cycles: 6000, p999: 12 us, max: 40
/// us}}`.
std::string write_times(const ExecutionTimes& times);
ExecutionTimes parse_times(std::string_view text, const std::string& name,
                           base::Diagnostics& diagnostics);

/// Which load a thread is.
struct ThreadLoad {
  /// Where the figures of its load come from.
  enum class Source : std::uint8_t { kUnknown, kDeclared, kMeasured };

  std::string name;
  exec::Activity activity;
  base::Duration period{};  ///< of its trigger if it is triggered; 0: unknown
  base::Duration cost{};    ///< execution time of one cycle
  Source source = Source::kUnknown;
  base::Duration response{};  ///< from release to end, at worst; 0: not known

  bool known() const { return source != Source::kUnknown && period > base::Duration::zero(); }
  double utilisation() const {
    return known() ? static_cast<double>(cost.count()) / static_cast<double>(period.count()) : 0.0;
  }
};

/// The load of all threads.
struct Schedule {
  std::vector<ThreadLoad> threads;
  int cpus = 1;

  double utilisation() const;   ///< of all threads; `cpus` is everything the machine has
  std::string to_text() const;  ///< a table for people
};

/// Computes the load from declared budgets, else from measured times, and checks it: the sum of the
/// utilisations on each set of CPUs, and the worst response time of each real-time thread against
/// its period. Says which threads' times are unknown.
/// @param cpus  of the machine that is to run it
Schedule check_schedule(const exec::Blueprint& blueprint, const exec::Plan& plan,
                        const ExecutionTimes& measured, int cpus, base::Diagnostics& diagnostics);

}  // namespace armature::analysis
