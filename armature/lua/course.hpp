// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <optional>

#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"

namespace armature::lua {

/// The application's run, which goes on only as far as it is let.
/// @thread the controlling one
class Course {
 public:
  Course(exec::Application& application, base::Duration duration, const platform::StopSignal* stop)
      : application_(application), end_(base::later(application.now(), duration)), stop_(stop) {}

  /// Lets it go on until `until`, or until `condition` is true; false if the run has ended.
  bool pass(base::Time until, const std::function<bool()>& condition = {}) {
    if (ended_) return false;
    const exec::RunEnd end = application_.run_until(std::min(until, end_), condition, stop_);
    const bool goes_on = end == exec::RunEnd::kTimeUp || end == exec::RunEnd::kConditionMet;
    if (!goes_on) ended_ = end;
    if (goes_on && application_.now() >= end_) ended_ = exec::RunEnd::kTimeUp;
    return !ended_;
  }
  /// Likewise up to now: in real time what has come in between is heard of.
  bool keep_up() { return pass(application_.now()); }
  void stop() {
    if (!ended_) ended_ = exec::RunEnd::kStopRequested;
  }

  bool has_ended() const { return ended_.has_value(); }
  exec::RunEnd end() const { return ended_.value_or(exec::RunEnd::kStopRequested); }

 private:
  exec::Application& application_;
  base::Time end_;
  const platform::StopSignal* stop_;
  std::optional<exec::RunEnd> ended_;
};

}  // namespace armature::lua
