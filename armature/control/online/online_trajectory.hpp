// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/motion_limit.hpp"
#include "armature/control/online/axis_problem.hpp"
#include "armature/control/online/phased_motion.hpp"
#include "armature/control/online/target_refusal.hpp"

namespace armature::control {

/// Moves several axes from any state of motion to any other, as fast as the limits of velocity,
/// acceleration and jerk of each allow; a new target may come at any time. All arrive together:
/// each takes the least duration that is possible for all (Berscheid and Kroeger 2021,
/// "Jerk-limited Real-time Trajectory Generation with Arbitrary Target States"). See `AxisProblem`.
///
/// An axis that is beyond its limits is brought back first, as fast as its jerk allows. Axes that
/// arrive in motion, and are given no other target, brake to rest from there. Where the position
/// limits of an axis forbid the motion that arrives with the others, it arrives at rest sooner.
/// A `MotionLimit` is kept by motions, not by stops: axes that brake on their own may add up.
/// What is refused changes nothing. One thread uses it.
///
/// stop() stays within the position limits at any moment of any motion that was taken: what a stop
/// may come to counts as part of it (`extent_of_stops`).
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
    double shortest_s = 0.0;     ///< of a motion's kTooFast: the time that the limits allow
    double fastest = 0.0;        ///< of a jog's kTooFast: the velocity that the limits allow

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
  /// @param limit   looked at along the motion, or nullptr. Where it is exceeded, the motion takes
  ///                longer, until it is kept.
  /// @return any refusal of the enumeration but kZeroVelocity and kAtLimit
  /// @rt nonblocking, no allocation, O(axes)
  Answer move_to(const State& target, double time_s = 0.0, MotionLimit* limit = nullptr);

  /// Moves one axis with `velocity` to its limit from the present state, while the others brake to
  /// rest: who lets go of it says stop().
  /// @param axis      < axes()
  /// @param velocity  in the axis' unit and seconds, not 0; its sign is the direction
  /// @param limit     looked at along the motion, or nullptr
  /// @return kNotFinite, kZeroVelocity, kTooFast, kAtLimit, kNoPosition, kTooLong, kLeavesLimits
  /// @rt nonblocking, no allocation, O(axes)
  Answer jog(std::size_t axis, double velocity, MotionLimit* limit = nullptr);

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
  double progress() const { return under_way() ? elapsed_s() / duration_s_ : 1.0; }  ///< 0..1
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
  void pose(std::size_t axis, const MotionSample& target, const JerkLimits& limits);
  double least_duration_s(double from_s) const;
  Answer plan(const State& target, double time_s);
  Answer plan_within(const State& target, double time_s, MotionLimit& limit);
  Answer lengthen(const State& target, double time_s, MotionLimit& limit);
  double most_used(MotionLimit& limit);
  bool solve(std::size_t axis, const MotionSample& target, double duration_s,
             const JerkLimits& limits);
  bool stays_within(std::size_t axis) const;
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
  std::vector<double> looked_at_;  ///< positions where a `MotionLimit` looks, and the velocities
  std::vector<double> velocities_there_;
  double planned_s_ = 0.0;  ///< duration of `next_`
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
