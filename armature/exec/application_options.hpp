// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/act.hpp"
#include "armature/exec/black_box.hpp"
#include "armature/exec/pace.hpp"
#include "armature/exec/timeline.hpp"
#include "armature/rt/log.hpp"
#include "armature/types/enum.hpp"

namespace armature::exec {

/// How much of the real-time means of the system an application asks for.
enum class RealtimeMode : std::uint8_t {
  kOff,      ///< asks for nothing
  kPrefer,   ///< asks, and goes on with what it gets
  kRequire,  ///< refuses to start without all of it
};

/// What a fault of one component means for the application.
enum class OnFault : std::uint8_t {
  kStopDependents,  ///< what depends on the faulted component stops, the rest goes on
  kStopAll,         ///< everything stops in order
  /// What reads from it goes on with its last values, unless the connection says otherwise.
  kKeepRunning,
};
ARMATURE_ENUM(OnFault, kStopDependents, kStopAll, kKeepRunning);

/// On whose behalf operations and commands are called.
enum class Caller : std::uint8_t {
  kOperator,  ///< the operator's own program
  kScript,
  kRemote,  ///< another process
};
ARMATURE_ENUM(Caller, kOperator, kScript, kRemote);

/// An act of the operator (`component::by_operator`) that a caller may do in the operator's stead:
/// an operation to call, or a property to set.
struct Grant {
  Caller caller;
  std::string component;
  std::string operation;
};

/// A command without arguments.
struct CommandName {
  std::string component;
  std::string command;
};

/// Of simulated time that is to pass as real time once did.
struct RecordedInstants {
  base::Time begin{};  ///< what the time is at first
  /// By periodic threads: when their cycles come, in order, instead of once a period. Threads that
  /// are not named keep their periods.
  std::map<std::string, std::vector<base::Time>> cycles{};
};

/// How an application runs.
struct ApplicationOptions {
  RealtimeMode realtime = RealtimeMode::kOff;
  bool simulated = false;
  Pace pace;                  ///< of simulated time
  RecordedInstants instants;  ///< of simulated time
  OnFault on_fault = OnFault::kStopDependents;
  std::vector<Grant> grants;
  std::vector<CommandName> before_stop;                        ///< for `run_before_stop`
  base::Duration hold_at_stop = std::chrono::minutes(1);       ///< while the operator is asked
  base::Duration before_stop_limit = std::chrono::minutes(1);  ///< for each of them
  base::Duration hook_limit = std::chrono::seconds(10);        ///< a hook that takes longer hangs
  base::Duration stop_limit = std::chrono::seconds(1);         ///< the same while stopping
  /// Execution times of components are taken in every n-th cycle; 0: about four times a second,
  /// which is nearly free at any rate and number of components.
  std::uint64_t measure_every = 0;
  /// Where the files of recorders go that are named without a folder; empty: the working directory.
  std::string output_folder;
  std::function<void(const rt::LogRecord&)> log;  ///< called by the controlling thread
  TimelineOptions timeline;
  BlackBoxOptions black_box;
  /// Called by `start` when all is in place, before the first cycle; if it throws, nothing starts.
  std::function<void()> ready;
  /// Called by the controlling thread while it lets the application run, which it may use: in
  /// simulated time whenever all that is due at an instant is done, else every millisecond.
  std::function<void()> attend;
  /// Is told each act before it is done, by the controlling thread; what only reads is no act.
  std::function<void(const Act&)> acts;
};

}  // namespace armature::exec
