// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "armature/control/taught/taught_motion.hpp"
#include "armature/control/trajectory.hpp"

namespace armature::control {

/// What one axis may do, in its unit (rad or m) and seconds.
struct PathLimits {
  double max_velocity = 0.0;
  double max_acceleration = 0.0;
};

/// A taught path with the speed at each place on it: as near to a wanted speed as the limits of
/// velocity and acceleration of each axis allow, from rest to rest. The square of the speed is
/// piecewise linear on a grid of 10 ms of the teaching, found by a pass forth and one back (Bobrow,
/// Dubowsky and Gibson 1985). A fifth of each acceleration is kept for speeding up and braking, so
/// that a stop is possible at any place. Planning goes on in small pieces, one a cycle.
/// One thread uses it.
class TimedPath {
 public:
  /// Of the speed's change [1/s]: a stop from that of the teaching takes a tenth of a second.
  static constexpr double kHardest = 10.0;

  /// @param capacity  the most control points of a path
  TimedPath(std::vector<PathLimits> limits, std::size_t capacity);

  std::size_t capacity() const { return capacity_; }
  std::size_t axes() const { return limits_.size(); }

  /// Takes a path, to be planned; copies it.
  /// @param points  control points x axes, 4 to capacity() of them, finite
  /// @param speed   > 0; 1 is that of the teaching
  /// @rt nonblocking, no allocation, O(points)
  void load(std::span<const double> points, double speed);

  /// Plans a piece: at most 64 places of the grid.
  /// @param limit  of the whole robot, asked at each place; nullptr if there is none
  /// @return whether all is planned
  /// @rt nonblocking, no allocation, O(64 axes)
  bool plan(MotionLimit* limit);
  bool planned() const { return phase_ == Phase::kPlanned; }

  /// Goes to the begin, at rest there.
  /// @rt nonblocking, no allocation, O(axes)
  void begin();
  /// Goes on along the path by `period_s`, >= 0; once braking, slower and slower.
  /// @rt nonblocking, no allocation, O(places passed * axes)
  void step(double period_s);
  /// Brakes on the path as fast as the limits allow, from the next step on.
  void brake() { braking_ = true; }
  /// It has come to its end, or to rest by a brake.
  bool rests() const { return rests_; }

  /// Of all, once it is planned; before, what the wanted speed would take.
  double duration_s() const { return duration_s_; }
  double remaining_s() const { return rests_ ? 0.0 : remaining_s_; }
  /// Whether the limits make it slower than the wanted speed somewhere besides its ends.
  bool slowed() const { return slowed_; }
  /// False if the limit of the whole robot forbids any speed somewhere; known once it is planned.
  bool possible() const { return possible_; }

  /// One number per axis.
  std::span<const double> positions() const { return positions_; }
  std::span<const double> velocities() const { return velocities_; }
  std::span<const double> accelerations() const { return accelerations_; }

 private:
  static constexpr std::size_t kPlacesPerKnot = 4;
  static constexpr std::size_t kCostOfCurve = 16;           ///< beside that of the passes
  static constexpr std::size_t kPiece = 64 * kCostOfCurve;  ///< planned in a cycle
  static constexpr double kStep_s = kKnotSpacing_s / static_cast<double>(kPlacesPerKnot);
  enum class Phase { kCurves, kForth, kBack, kPlanned };

  void evaluate(std::size_t knot, double share);
  void measure(std::size_t place, MotionLimit* limit);
  void measure_segment(std::size_t place);
  std::pair<double, double> steepest(std::size_t axis) const;
  void come_to_rest(std::size_t place);
  double move_on(double time_s);
  void sample();

  std::vector<PathLimits> limits_;
  std::size_t capacity_;
  std::vector<double> points_;
  std::size_t places_ = 0;  ///< of the grid
  double speed_ = 1.0;

  // For each place.
  std::vector<double> most_;     ///< the largest square of the speed
  std::vector<double> square_;   ///< that which is planned
  std::vector<double> hardest_;  ///< change of the speed that is possible from there to the next

  Phase phase_ = Phase::kPlanned;
  std::size_t next_ = 0;  ///< place to be planned
  double sum_s_ = 0.0;    ///< of the places that are planned
  double duration_s_ = 0.0;
  double remaining_s_ = 0.0;
  bool slowed_ = false;
  bool possible_ = true;

  // Where it is.
  std::size_t segment_ = 0;
  double beyond_s_ = 0.0;  ///< behind the begin of the segment, in the teaching's time
  double rate_ = 0.0;      ///< present speed
  double change_ = 0.0;    ///< of it [1/s]
  bool braking_ = false;
  bool rests_ = true;
  std::vector<double> positions_;
  std::vector<double> velocities_;
  std::vector<double> accelerations_;
  std::vector<double> before_slope_;
  std::vector<double> before_curvature_;
};

}  // namespace armature::control
