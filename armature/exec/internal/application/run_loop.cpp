// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/run_loop.hpp"

#include <algorithm>
#include <chrono>

#include "armature/platform/clock.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec::internal {

void RunLoop::begin_anew() {
  simulation_.reset();
  journal_.begin_anew();
  set_pace(options_.pace);
  if (options_.simulated) simulation_.emplace(pointers_to(engines_));
}

RunEnd RunLoop::run_until(base::Time end, const std::function<bool()>& condition,
                          const platform::StopSignal* stop) {
  journal_.note_cancelled();
  return options_.simulated ? simulate_until(end, condition, stop)
                            : attend_until(end, condition, stop);
}

RunEnd RunLoop::attend_until(base::Time end, const std::function<bool()>& condition,
                             const platform::StopSignal* stop) {
  constexpr base::Duration kLogPeriod = std::chrono::milliseconds(20);
  constexpr base::Duration kConditionPeriod = std::chrono::milliseconds(1);
  const bool often = condition || options_.attend;
  const base::Duration period = often ? kConditionPeriod : kLogPeriod;
  while (true) {
    outlets_.drain();
    if (stop != nullptr && stop->received()) return RunEnd::kStopRequested;
    if (const std::optional<RunEnd> end_now = end_by_fault()) return *end_now;
    const base::Time at = clock_.now();
    attend();
    if (condition && condition()) return RunEnd::kConditionMet;
    if (at >= end) return RunEnd::kTimeUp;
    const base::Time next = std::min(end, at + period);
    if (stop != nullptr) {
      stop->wait_until(next);
    } else {
      platform::sleep_until(next);
    }
  }
}

RunEnd RunLoop::simulate_until(base::Time end, const std::function<bool()>& condition,
                               const platform::StopSignal* stop) {
  pacer_.set(pace().rate, clock_.now(), platform::monotonic_now());
  while (true) {
    while (Engine* const engine = simulation_->take_turn(clock_.now())) {
      journal_.count_turn();
      outlets_.drain_after_turn(*engine);
      if (const std::optional<RunEnd> end_now = end_by_fault()) return *end_now;
      if (stop != nullptr && stop->received()) return RunEnd::kStopRequested;
    }
    attend();
    if (condition && condition()) return RunEnd::kConditionMet;
    if (clock_.now() >= end) return RunEnd::kTimeUp;
    if (pace().waits() && stop != nullptr && stop->received()) return RunEnd::kStopRequested;
    pass_to(std::min(end, simulation_->next_due()), stop);
  }
}

void RunLoop::pass_to(base::Time next, const platform::StopSignal* stop) {
  constexpr base::Duration kLongestWait = std::chrono::milliseconds(1);
  if (pace().waits()) {
    const base::Time now = platform::monotonic_now();
    const base::Time due = pacer_.time_of(next);
    if (due > now) {
      const base::Time until = std::min(due, now + kLongestWait);
      if (stop != nullptr) {
        stop->wait_until(until);
      } else {
        platform::sleep_until(until);
      }
      return;
    }
    pacer_.arrive(next, now);
  }
  clock_.go_to(next);
}

void RunLoop::set_pace(const Pace& pace) {
  pacer_.set(pace.rate, clock_.now(), platform::monotonic_now());
  if (pace.paused) {
    pacer_.pause();
  } else {
    pacer_.resume(clock_.now(), platform::monotonic_now());
  }
}

std::optional<RunEnd> RunLoop::end_by_fault() {
  health_.take_leave_of_the_dead(engines_);
  return health_.end_by_fault(options_.on_fault);
}

void RunLoop::attend() {
  outlets_.write_black_boxes(health_.incidents());
  stop_guard_.finish();
  outlets_.tell_losses_now_and_then();
  if (!options_.attend) return;
  journal_.set_attending(true);
  options_.attend();
  journal_.note_cancelled();
  journal_.set_attending(false);
}

}  // namespace armature::exec::internal
