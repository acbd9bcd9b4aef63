// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::control {

/// Has signals go on from where another controller left them: the first output equals the present
/// one, and what that is apart from the first signal dies away smoothly.
///
///     output[k] = signal[k] + (present - mean) (1 - 3 x^2 + 2 x^3),  x = (t[k] - t[0]) / time
///
/// The mean is that of the first signals, up to x = `learning`, as far as they have come: where
/// joints are at rest the noise of a single one would be driven with until it has died away. Where
/// they move, what a controller does about that is no noise, and the first signal counts alone:
/// `learning` is 0.
///
/// Likewise `present` may be the noise of a single output: where there is a mean of those before
/// it, what it is apart from that dies away by x = `learning`.
///
/// Afterwards, and before anything was taken over, the output is the signal, to the bit.
class HandOver {
 public:
  /// What is remembered between two steps; one element for each signal.
  struct State {
    std::vector<double> present;  ///< not a number: this signal is not taken over
    std::vector<double> offsets;  ///< present, or the mean of those before it, - mean
    std::vector<double> noise;    ///< of the present one
    double learning = 0.0;
    base::Time begun{};
    int samples = 0;  ///< in the mean
    bool active = false;
  };

  /// Makes room for so many signals.
  /// @thread configuration only
  explicit HandOver(std::size_t signals = 0);

  /// The next output is `present`.
  /// @param learning  0 to 1
  /// @param lately    the mean of the outputs up to the present one; empty: that one itself
  /// @return false, and nothing is taken over, if these are not as many as the signals
  /// @rt nonblocking, no allocation, O(signals)
  bool begin(std::span<const double> present, double learning = 0.0,
             std::span<const double> lately = {});
  bool begin(double present) { return begin(std::span(&present, 1)); }

  /// Nothing is taken over any more.
  /// @rt nonblocking, no allocation
  void reset();

  /// Whether the output is not just the signal.
  bool active() const { return state_.active; }

  /// Makes outputs of `signals`, which are as many as there is room for.
  /// @param time  in which the difference dies away; not above 0: nothing is taken over
  /// @rt nonblocking, no allocation, O(signals)
  void step(std::span<double> signals, base::Time now, base::Duration time);

  const State& state() const { return state_; }

 private:
  void begin_at(std::span<const double> signals, base::Time now);
  void learn(std::span<const double> signals);

  State state_;
};

}  // namespace armature::control
