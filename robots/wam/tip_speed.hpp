// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "armature/base/time.hpp"

namespace armature::wam {

/// How fast elbow and wrist move, as the safety board finds it out from the positions of motors 1
/// to 4 that it hears: a speed for each round of all four.
///
/// The board's own way is not published; this is plain geometry (upper arm 0.55 m, forearm 0.35 m).
/// Nonblocking, and allocates nothing.
class TipSpeed {
 public:
  static constexpr std::size_t kMotors = 4;
  /// Rounds that are further apart tell nothing of speeds.
  static constexpr base::Duration kLongest = std::chrono::milliseconds(50);

  /// @param counts_per_turn  of the four motors' encoders
  explicit TipSpeed(const std::array<std::int32_t, kMotors>& counts_per_turn)
      : counts_per_turn_(counts_per_turn) {}

  /// @param motor   0 to 3
  /// @param zeroed  whether counts tell where the arm is; if not, the speed is the fastest joint's
  ///                with the longest arm that it may have
  /// @return [m/s] if this completes a round, and the last was not long ago
  std::optional<double> add(std::size_t motor, std::int32_t counts, base::Time now, bool zeroed);
  void forget();

  /// Of elbow and wrist, of joints that move.
  /// @param q, qd  of at least four joints [rad, rad/s]
  /// @return the faster one [m/s]
  static double of(std::span<const double> q, std::span<const double> qd);

 private:
  using Joints = std::array<double, kMotors>;
  Joints joints() const;

  const std::array<std::int32_t, kMotors> counts_per_turn_;
  std::array<std::optional<std::int32_t>, kMotors> counts_;
  std::optional<Joints> last_;
  base::Time last_time_{};
};

}  // namespace armature::wam
