// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/types/enum.hpp"

namespace armature::rover {

/// Which way the ball takes.
enum class BallWay : std::uint8_t {
  kRest,    ///< stays where it is
  kLine,    ///< rolls 2 m, and rests for 2 s after the first
  kCircle,  ///< a circle of 1.5 m about the arena's middle, to the left, without end
  kEight,   ///< an eight about the arena's middle, without end
  kHide,    ///< to the right of the screen, then behind it to its left
  kCarry,   ///< carried by a hand, above the camera's view, to where it is told
  kPorts,   ///< where the inputs X and Y say
};
ARMATURE_ENUM(BallWay, kRest, kLine, kCircle, kEight, kHide, kCarry, kPorts);

/// Where the ball's middle is [m].
struct BallPoint {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// The ball's motion, of constant speed but where it rests. A way that begins elsewhere is rolled
/// to first, in a straight line.
class BallPath {
 public:
  struct Config {
    double speed = 0.3;    ///< [m/s], > 0; a hand carries with 2 m/s
    BallPoint carry_to{};  ///< z does not count
  };

  explicit BallPath(const BallPoint& begin) : at_(begin) {}

  /// Begins a way, where the ball is now.
  void go(BallWay way, const Config& config);
  /// Puts it there at once, if it is on the way kPorts.
  void move_to(double x, double y);
  /// @param dt  [s]
  /// @rt nonblocking, no allocation
  void step(double dt);

  const BallPoint& at() const { return at_; }
  BallWay way() const { return way_; }

 private:
  enum class Phase : std::uint8_t { kRollThere, kOnWay, kLift, kCarried, kSetDown, kArrived };

  BallPoint on_curve(double angle) const;
  bool roll_towards(const BallPoint& target, double length);
  void step_line(double dt);
  void step_curve(double length);
  void step_carry(double dt);

  Config config_;
  BallPoint at_;
  BallPoint begin_;   ///< of the line
  BallPoint target_;  ///< of what is straight
  BallWay way_ = BallWay::kRest;
  Phase phase_ = Phase::kArrived;
  double angle_ = 0.0;   ///< of circle and eight [rad]
  double rested_ = 0.0;  ///< [s] in the middle of the line
};

}  // namespace armature::rover
