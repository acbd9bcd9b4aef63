// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace armature::control {

/// What has driven joints at rest lately, without the noise of single samples: for whoever takes
/// over from it. In motion it is nothing: there the last sample counts, and what came before it
/// was for another place.
class RestingMean {
 public:
  /// Makes room for so many signals.
  /// @param samples  in the mean, >= 1: those before count less and less
  /// @thread configuration only
  explicit RestingMean(std::size_t signals = 0, int samples = 1)
      : mean_(signals, 0.0), most_(samples) {}

  /// @param signals  of this sample, as many as there is room for
  /// @param rests    the joints are at rest, and are to be
  /// @rt nonblocking, no allocation, O(signals)
  void add(std::span<const double> signals, bool rests) {
    if (!rests) return reset();
    if (samples_ < most_) ++samples_;
    const double weight = 1.0 / samples_;
    for (std::size_t i = 0; i < mean_.size(); ++i) mean_[i] += weight * (signals[i] - mean_[i]);
  }

  /// @rt nonblocking, no allocation
  void reset() { samples_ = 0; }

  /// Empty in motion.
  std::span<const double> get() const {
    return samples_ > 0 ? std::span<const double>(mean_) : std::span<const double>();
  }

 private:
  std::vector<double> mean_;
  int most_;
  int samples_ = 0;
};

}  // namespace armature::control
