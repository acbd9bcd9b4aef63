// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/online/axis_problem.hpp"
#include "armature/control/online/phased_motion.hpp"

namespace armature::control {

/// Why an `OnlineTrajectory` did not take a target.
enum class TargetRefusal {
  kNone,                 ///< it did
  kWrongNumber,          ///< not one number for each axis
  kNotFinite,            ///< a position, velocity, acceleration or time is not a finite number
  kOutsideLimits,        ///< a position is outside the position limits of its axis
  kVelocityTooHigh,      ///< a velocity is above the limit of its axis
  kAccelerationTooHigh,  ///< an acceleration is, or leads the velocity beyond its limit
  kLeavesLimits,         ///< the motion, or a stop from its end, leaves the position limits
  kNegativeTime,
  kTooFast,     ///< the limits allow it in a longer time: the answer has which
  kTooLong,     ///< it would take more than `OnlineTrajectory::kLongest_s`
  kNoPosition,  ///< where the axes are was never said: hold() or begin_at() comes first
};

/// A few words for a message, such as "a velocity is above the limit of its axis".
/// @rt nonblocking, no allocation
std::string_view to_text(TargetRefusal refusal);

/// Moves several axes from any state of motion to any other, as fast as the limits of velocity,
/// acceleration and jerk of each allow; a new target may come at any time. All arrive together:
/// each takes the least duration that is possible for all (Berscheid and Kroeger 2021,
/// "Jerk-limited Real-time Trajectory Generation with Arbitrary Target States"). See `AxisProblem`.
///
/// An axis that is beyond its limits is brought back first, as fast as its jerk allows. Axes that
/// arrive in motion, and are given no other target, brake to rest from there. Where the position
/// limits of an axis forbid the motion that arrives with the others, it arrives at rest sooner.
/// What is refused changes nothing. One thread uses it.
///
/// From all motions to targets at rest stop() stays within the position limits. On the way to a
/// target in motion that begins with a run-up, it may leave them by A^3 / 24J^2.
class OnlineTrajectory {
 public:
  static constexpr std::size_t kNoAxis = static_cast<std::size_t>(-1);
  static constexpr double kLongest_s = 1e9;

  /// Limits of one axis, in its unit (rad or m) and seconds.
  struct Axis {
    double max_velocity = 0.0;                                ///< > 0, finite
    double max_acceleration = 0.0;                            ///< > 0, finite
    double max_jerk = 0.0;                                    ///< > 0, finite
    double lower = -std::numeric_limits<double>::infinity();  ///< < upper
    double upper = std::numeric_limits<double>::infinity();
  };
  /// The axes that move together.
  struct Config {
    std::vector<Axis> axes;  ///< at least one
  };
  /// Where the axes are to be, or are; one number for each.
  struct State {
    std::span<const double> positions;
    std::span<const double> velocities = {};     ///< empty: 0
    std::span<const double> accelerations = {};  ///< empty: 0
  };
  /// Whether a target was taken, and if not, why.
  struct [[nodiscard]] Answer {
    TargetRefusal refusal = TargetRefusal::kNone;
    std::size_t axis = kNoAxis;  ///< the first one it is about, if it is about one
    double shortest_s = 0.0;     ///< of kTooFast: the time that the limits allow

    bool accepted() const { return refusal == TargetRefusal::kNone; }
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<void> check(const Config& config);
  static base::Result<OnlineTrajectory> make(const Config& config);

  /// Rests at `positions` from now on, whatever went on. Refuses kWrongNumber and kNotFinite;
  /// positions outside the limits are facts.
  /// @rt nonblocking, no allocation, O(axes)
  Answer hold(std::span<const double> positions);

  /// Is in `state` from now on, also beyond limits, and brakes to rest from there unless a target
  /// follows. Refuses kWrongNumber and kNotFinite.
  /// @rt nonblocking, no allocation, O(axes)
  Answer begin_at(const State& state);

  /// What is wrong with a target wherever the motion begins: refuses kWrongNumber, kNotFinite,
  /// kOutsideLimits, kVelocityTooHigh, kAccelerationTooHigh and kNegativeTime.
  /// @rt nonblocking, no allocation, O(axes)
  Answer check_target(const State& target, double time_s = 0.0) const;

  /// Goes to `target` from the present state. The target that it goes to already changes nothing.
  /// @param time_s  what it takes, or the next longer time that is possible; 0: the shortest
  /// @return any refusal of the enumeration
  /// @rt nonblocking, no allocation, O(axes)
  Answer move_to(const State& target, double time_s = 0.0);

  /// Brakes each axis to rest as fast as its limits allow, and holds there. Nothing happens if it
  /// is stopping already.
  /// @rt nonblocking, no allocation, O(axes)
  void stop();

  /// Goes on by `period`, >= 0; afterwards positions(), velocities() and accelerations() are those
  /// of the new time.
  /// @rt nonblocking, no allocation, O(axes)
  void step(base::Duration period);

  bool under_way() const { return elapsed_s() < duration_s_; }
  double elapsed_s() const { return static_cast<double>(elapsed_.count()) * 1e-9; }
  double duration_s() const { return duration_s_; }  ///< of the present or last motion
  double remaining_s() const { return under_way() ? duration_s_ - elapsed_s() : 0.0; }
  std::size_t axes() const { return axes_.size(); }
  /// @param axis  < axes()
  const PhasedMotion& motion(std::size_t axis) const { return motions_[axis]; }

  /// One number per axis; valid until the trajectory is gone.
  std::span<const double> positions() const { return positions_; }
  std::span<const double> velocities() const { return velocities_; }
  std::span<const double> accelerations() const { return accelerations_; }

 private:
  explicit OnlineTrajectory(const Config& config);

  JerkLimits limits_of(std::size_t axis) const;
  static MotionSample state_of(const State& state, std::size_t axis);
  Answer check_state(const State& state) const;
  bool goes_there(const State& target, double time_s) const;
  MotionSample now(std::size_t axis) const;
  void pose(std::size_t axis, const MotionSample& target);
  double least_duration_s(double from_s) const;
  bool solve(std::size_t axis, const MotionSample& target, double duration_s);
  bool stays_within(std::size_t axis, const MotionSample& target) const;
  void brake(std::size_t axis);
  void brake_all();
  void begin(double duration_s);
  void sample_all();

  std::vector<Axis> axes_;
  std::vector<PhasedMotion> motions_;
  std::vector<PhasedMotion> next_;  ///< of a target that may be refused
  std::vector<std::optional<AxisProblem>> problems_;
  std::vector<double> within_s_;  ///< when an axis is within its limits
  std::vector<MotionSample> targets_;
  base::Duration elapsed_{};
  double duration_s_ = 0.0;
  double asked_s_ = 0.0;
  bool position_known_ = false;
  bool has_target_ = false;  ///< it goes to `targets_`, or is there
  std::vector<double> positions_;
  std::vector<double> velocities_;
  std::vector<double> accelerations_;
};

}  // namespace armature::control
