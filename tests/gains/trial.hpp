// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace armature::gains {

/// How often a set of gains is drawn for each joint: a few, or what the environment says.
inline int sets() {
  const char* const wanted = std::getenv("GAINS_SETS");
  return wanted == nullptr ? 3 : std::atoi(wanted);
}

/// Whether a joint shakes that was pushed: its velocity does not die away. One that swings slowly
/// and ever less does not.
class Shaking {
 public:
  explicit Shaking(int cycles) : cycles_(cycles) {}

  /// @param velocity  [rad/s], once in each cycle
  void add(double velocity) {
    const int quarter = std::min(3, 4 * cycle_++ / cycles_);
    double& largest = largest_[quarter];
    largest = std::isfinite(velocity) ? std::max(largest, std::abs(velocity)) : HUGE_VAL;
  }
  bool found() const {
    constexpr double kNoise = 0.005;  // [rad/s]
    constexpr double kDiesAway = 0.7;
    return largest_[3] > kNoise && !(largest_[3] < kDiesAway * largest_[1]);
  }

 private:
  int cycles_;
  int cycle_ = 0;
  double largest_[4] = {};
};

/// What became of the sets of one joint.
struct Tally {
  int accepted = 0;
  int accepted_and_shaking = 0;
  int refused = 0;
  int refused_and_quiet = 0;         ///< as they are
  int refused_and_quiet_anyway = 0;  ///< and with half and twice of them

  void print(const std::string& what) const {
    std::printf("%-28s %4d %8d %8d %8d %8d\n", what.c_str(), accepted, accepted_and_shaking,
                refused, refused_and_quiet, refused_and_quiet_anyway);
  }
  static void print_head() {
    std::printf("%-28s %4s %8s %8s %8s %8s\n", "joint", "good", "shake", "refused", "quiet",
                "at any");
  }
};

/// @param accepted  by the check
/// @param shakes    with a share of the gains
inline void judge(Tally& tally, bool accepted, const std::function<bool(double)>& shakes) {
  const bool shaking = shakes(1.0);
  if (accepted) {
    ++tally.accepted;
    tally.accepted_and_shaking += shaking ? 1 : 0;
    return;
  }
  ++tally.refused;
  if (shaking) return;
  ++tally.refused_and_quiet;
  if (!shakes(2.0) && !shakes(0.5)) ++tally.refused_and_quiet_anyway;
}

/// No set that is accepted shakes; of those that are refused, few would have been quiet with the
/// margin that is asked for.
inline void expect_good(const Tally& tally, const std::string& what) {
  EXPECT_EQ(tally.accepted_and_shaking, 0) << what;
  if (tally.refused < 20) return;
  EXPECT_LE(10 * tally.refused_and_quiet_anyway, tally.refused) << what;
}

}  // namespace armature::gains
