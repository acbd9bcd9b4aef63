// SPDX-License-Identifier: Apache-2.0
#pragma once

// How a running application, its threads, components and commands stand: plain structs.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/operations/command.hpp"

namespace armature::inspect {

/// A thread of the application. Times are since its start.
struct ThreadStatus {
  std::string name;
  std::string activity;        ///< `every 10 ms`, `triggered`, ...
  std::size_t components = 0;  ///< how many run in it
  std::uint64_t cycles = 0;
  std::uint64_t skipped = 0;
  std::uint64_t log_lines_dropped = 0;
  double cycle_median_us = 0.0;
  double cycle_high_us = 0.0;  ///< 99.9 % of its cycles take no longer
  double cycle_most_us = 0.0;
  double load_percent = 0.0;       ///< 0 if it has no period
  double latency_median_us = 0.0;  ///< how late its cycles begin
  double latency_most_us = 0.0;

  bool operator==(const ThreadStatus&) const = default;
};

/// An application as a whole.
struct ApplicationStatus {
  std::string name;
  base::Time time{};  ///< of its own clock
  bool simulated = false;
  std::string mode;             ///< empty if it has none
  std::uint64_t faults = 0;     ///< since the start
  std::uint64_t reactions = 0;  ///< components that a declared reaction stopped since the start
  std::vector<ThreadStatus> threads;

  bool operator==(const ApplicationStatus&) const = default;
};

/// Which component it is, and how it stands.
struct ComponentStatus {
  std::string model;
  std::string name;
  std::optional<component::State> state;  ///< nothing: whoever hosts it does not say
  std::string reason;                     ///< why it does not run; may be empty
  std::string thread;                     ///< that runs it; empty outside of an application
  bool autostart = false;                 ///< the deployment starts it
  int start_order = 0;  ///< its place when all are started, writers before readers

  bool operator==(const ComponentStatus&) const = default;
};

/// Components that do not run.
struct Faults {
  std::uint64_t faults = 0;
  std::uint64_t reactions = 0;
  std::vector<ComponentStatus> components;

  bool operator==(const Faults&) const = default;
};

/// A command that was begun, and how it fares.
struct CommandStatus {
  std::int32_t handle = 0;  ///< by which its view knows it
  std::string name;         ///< `Generator.moveTo`
  component::CommandStage stage = component::CommandStage::kFree;
  bool ended = false;
  double progress = 0.0;  ///< 0 to 1
  std::string reason;     ///< why it failed or was cancelled

  bool operator==(const CommandStatus&) const = default;
};

}  // namespace armature::inspect
