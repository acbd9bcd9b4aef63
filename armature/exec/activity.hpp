// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/types/enum.hpp"

namespace armature::exec {

using types::name_of;

/// What a periodic thread does with cycles whose time has passed.
enum class Overrun : std::uint8_t {
  kSkip,     ///< leaves them out, counted
  kCatchUp,  ///< runs them at once, one after the other
  kFault,    ///< skips, and faults its components after so many late cycles in a row
};
ARMATURE_ENUM(Overrun, kSkip, kCatchUp, kFault);

/// How a component is executed; the deployment's choice alone.
struct Activity {
  /// What makes a component run.
  enum class Kind : std::uint8_t {
    kPeriodic,    ///< own thread, runs at fixed times
    kTriggered,   ///< own thread, runs when something arrives
    kSequential,  ///< no thread: runs in the thread of whoever triggers it
  };
  /// Which scheduling policy of the system its thread asks for.
  enum class Scheduler : std::uint8_t { kOther, kRealtime, kDeadline };

  Kind kind = Kind::kSequential;
  base::Duration period{};
  Scheduler scheduler = Scheduler::kOther;
  int priority = 0;  ///< 1..99 for kRealtime, 99 most urgent
  std::vector<int> cpus;
  Overrun overrun = Overrun::kSkip;
  int late_cycles_to_fault = 5;
  base::Duration budget{};  ///< declared execution time of a cycle; zero: not declared
  std::string thread;       ///< periodic components that name the same thread share it

  static Activity periodic(base::Duration period, int priority = 0);
  static Activity triggered(int priority = 0);
  static Activity sequential() { return {}; }

  bool owns_thread() const { return kind != Kind::kSequential; }
};

ARMATURE_ENUM(Activity::Kind, kPeriodic, kTriggered, kSequential);
ARMATURE_ENUM(Activity::Scheduler, kOther, kRealtime, kDeadline);

/// Higher is more urgent: deadline threads, then real-time priorities, then all others.
int urgency(const Activity& activity);

}  // namespace armature::exec
