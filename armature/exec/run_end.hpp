// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "armature/component/component.hpp"
#include "armature/rt/statistics.hpp"
#include "armature/types/enum.hpp"

namespace armature::exec {

/// What the application does before it stops.
enum class Leave : std::uint8_t {
  kInOrder,       ///< the commands of `before_stop`
  kAfterMistake,  ///< nothing begins: who commanded it does not know what it does
};

/// What a component keeps from moving by itself, as it says (component/holding.hpp).
struct Held {
  std::string component;
  std::string what;
  bool answers = true;  ///< its thread does; else nobody knows, and it cannot go on holding
};

/// Why a run ended.
enum class RunEnd : std::uint8_t {
  kTimeUp,
  kStopRequested,
  kFaulted,
  kStoppedByReaction,
  kConditionMet
};
ARMATURE_ENUM(RunEnd, kTimeUp, kStopRequested, kFaulted, kStoppedByReaction, kConditionMet);

/// What a thread did since its start.
struct ThreadStatistics {
  std::string name;
  std::uint64_t cycles_run;
  std::uint64_t cycles_skipped;
  std::uint64_t log_lines_dropped;
  rt::DistributionSummary latency_ns;   ///< periodic threads: how late cycles began
  rt::DistributionSummary cycle_ticks;  ///< multiply with platform::tick_period_ns()
};

/// A component that did not get to the end in good order.
struct Casualty {
  std::string component;
  component::State state;  ///< when the application was stopped
  std::string reason;
};

}  // namespace armature::exec
