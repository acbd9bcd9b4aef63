// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::studio::internal {

class Relay;

/// Ends what a run does, by the run's own `disarm`; a run that does not confirm it in time, that
/// has none, or that has not said what it has is stopped, if it is the studio's own.
/// @thread any
class EmergencyStops {
 public:
  /// So long a run has to confirm.
  static constexpr base::Duration kPatience = std::chrono::seconds(1);
  /// What one of them did.
  struct Outcome {
    std::vector<std::string> disarmed;  ///< components that have confirmed it
    std::string stopped;                ///< why the run was asked to stop; empty: it was not
  };
  using Told = std::function<void(const base::Result<Outcome>&)>;

  /// Stops the run; the error says why it cannot, and `why` it should have.
  using StopRun = std::function<base::Result<void>(const std::string& why)>;

  EmergencyStops(Relay& relay, StopRun stop_run) : relay_(relay), stop_run_(std::move(stop_run)) {}

  /// Acts at once.
  /// @param told  called once, by this thread or another one; the error: the run cannot be stopped
  void press(base::Time now, Told told);
  /// Stops runs that have not confirmed in time.
  void look(base::Time now);

 private:
  struct Pressed;

  void confirm(Pressed& pressed, const std::string& component, const base::Result<void>& done);
  void end(Pressed& pressed, const std::string& why_stop);

  Relay& relay_;
  const StopRun stop_run_;
  std::mutex mutex_;  ///< of the next, and of what they have
  std::vector<std::shared_ptr<Pressed>> pressed_;
};

}  // namespace armature::studio::internal
