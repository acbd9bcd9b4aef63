// SPDX-License-Identifier: Apache-2.0
#pragma once

// The fastest motion by brute force, for tests: by nothing but integration of phases of constant
// jerk and a search for the times at which the jerk switches.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "armature/control/online/phased_motion.hpp"

namespace armature::control {

/// Searches the motions with a first phase of jerk +J up to the acceleration's limit, held there, a
/// last one of the same kind seen backward in time, and -J between them, with a pause at the
/// velocity's limit. Then the mirrored ones.
class SwitchingSearch {
 public:
  SwitchingSearch(const JerkLimits& limits, const MotionSample& start, const MotionSample& target)
      : limits_(limits), start_(start), target_(target) {}

  /// @return the shortest duration that the grid shows, infinite if it shows none
  double duration_s(int steps) const {
    SwitchingSearch mirrored = *this;
    mirrored.start_ = mirror(start_);
    mirrored.target_ = mirror(target_);
    return std::min(one_side_s(steps), mirrored.one_side_s(steps));
  }

 private:
  struct Candidate {
    double duration_s = std::numeric_limits<double>::infinity();
    double miss = 0.0;  ///< of the target's position
  };
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  static MotionSample mirror(const MotionSample& s) {
    return {-s.position, -s.velocity, -s.acceleration};
  }

  /// `state` after `time_s` with the jerk +J, or with none once the acceleration is at its limit.
  MotionSample pushed(const MotionSample& state, double time_s) const {
    const double rise_s = std::max(0.0, (limits_.acceleration - state.acceleration) / limits_.jerk);
    const MotionSample risen = after(state, std::min(time_s, rise_s), limits_.jerk);
    return after(risen, std::max(0.0, time_s - rise_s), 0.0);
  }
  /// The state so long before the target; backward in time and mirrored it is pushed, too.
  MotionSample before_target(double time_s) const {
    const MotionSample s =
        pushed({-target_.position, target_.velocity, -target_.acceleration}, time_s);
    return {-s.position, s.velocity, -s.acceleration};
  }
  /// Where the velocity peaks if the jerk is -J, or would have.
  double summit(const MotionSample& s) const {
    return s.velocity + s.acceleration * s.acceleration / (2.0 * limits_.jerk);
  }

  /// The middle: -J from `first` to `last`, which have the same summit.
  Candidate joined(const MotionSample& first, double first_s, const MotionSample& last,
                   double last_s) const {
    const double fall_s = (first.acceleration - last.acceleration) / limits_.jerk;
    if (fall_s < -1e-9) return {};
    const MotionSample end = after(first, std::max(0.0, fall_s), -limits_.jerk);
    return {first_s + fall_s + last_s, end.position - last.position};
  }

  /// The times of the last phase that suit a first one, by the summit of its velocity.
  std::vector<double> last_times(double wanted, double longest_s, int steps) const {
    std::vector<double> times;
    const auto error = [&](double t) { return summit(before_target(t)) - wanted; };
    double low = 0.0;
    double at_low = error(low);
    for (int i = 1; i <= steps; ++i) {
      const double high = longest_s * i / steps;
      const double at_high = error(high);
      if ((at_low > 0.0) != (at_high > 0.0)) times.push_back(bisect(low, high, error));
      low = high;
      at_low = at_high;
    }
    return times;
  }

  template <typename Function>
  static double bisect(double low, double high, const Function& error) {
    const bool above = error(low) > 0.0;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      ((error(middle) > 0.0) == above ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  double longest_push_s(const MotionSample& s) const {
    return 2.0 * limits_.velocity / limits_.acceleration +
           4.0 * std::sqrt(limits_.velocity / limits_.jerk) +
           2.0 * std::abs(s.acceleration) / limits_.jerk;
  }

  /// Sorted by the last phase's time; one that exceeds the velocity's limit does not count.
  std::vector<Candidate> candidates(double first_s, int steps) const {
    const MotionSample first = pushed(start_, first_s);
    const double wanted = summit(first);
    std::vector<Candidate> found;
    for (const double last_s : last_times(wanted, longest_push_s(target_), steps)) {
      const MotionSample last = before_target(last_s);
      const bool peaks = first.acceleration >= 0.0 && last.acceleration <= 0.0;
      const bool too_fast = peaks && wanted > limits_.velocity * (1.0 + 1e-9);
      found.push_back(too_fast ? Candidate{} : joined(first, first_s, last, last_s));
    }
    return found;
  }

  double one_side_s(int steps) const {
    const double longest_s = longest_push_s(start_);
    double best_s = cruising_s(steps);
    std::vector<Candidate> low = candidates(0.0, steps);
    for (int i = 1; i <= steps; ++i) {
      const double from_s = longest_s * (i - 1) / steps;
      const double to_s = longest_s * i / steps;
      std::vector<Candidate> high = candidates(to_s, steps);
      for (std::size_t k = 0; k < low.size() && high.size() == low.size(); ++k) {
        if (low[k].duration_s == kNever || high[k].duration_s == kNever) continue;
        if ((low[k].miss > 0.0) == (high[k].miss > 0.0)) continue;
        best_s = std::min(best_s, refined_s(from_s, to_s, k, low[k].miss > 0.0, steps));
      }
      low = std::move(high);
    }
    return best_s;
  }

  double refined_s(double low, double high, std::size_t k, bool above, int steps) const {
    for (int round = 0; round < 40; ++round) {
      const double middle = 0.5 * (low + high);
      const std::vector<Candidate> found = candidates(middle, steps);
      if (k >= found.size() || found[k].duration_s == kNever) return kNever;
      ((found[k].miss > 0.0) == above ? low : high) = middle;
    }
    const std::vector<Candidate> found = candidates(0.5 * (low + high), steps);
    const bool arrives = k < found.size() && std::abs(found[k].miss) < 1e-6;
    return arrives ? found[k].duration_s : kNever;
  }

  /// With a pause at the velocity's limit, as long as the distance wants it.
  double cruising_s(int steps) const {
    double best_s = kNever;
    const double longest_s = longest_push_s(start_);
    const auto error = [&](double t) { return summit(pushed(start_, t)) - limits_.velocity; };
    for (int i = 1; i <= steps; ++i) {
      const double from_s = longest_s * (i - 1) / steps;
      const double to_s = longest_s * i / steps;
      if ((error(from_s) > 0.0) == (error(to_s) > 0.0)) continue;
      const double first_s = bisect(from_s, to_s, error);
      const MotionSample first = pushed(start_, first_s);
      for (const double last_s : last_times(limits_.velocity, longest_push_s(target_), steps)) {
        const MotionSample last = before_target(last_s);
        if (first.acceleration < 0.0 || last.acceleration > 0.0) continue;
        const Candidate straight = joined(first, first_s, last, last_s);
        const double pause_s = -straight.miss / limits_.velocity;
        if (pause_s >= 0.0) best_s = std::min(best_s, straight.duration_s + pause_s);
      }
    }
    return best_s;
  }

  JerkLimits limits_;
  MotionSample start_;
  MotionSample target_;
};

}  // namespace armature::control
