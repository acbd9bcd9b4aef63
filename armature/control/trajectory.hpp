// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/control/motion_limit.hpp"
#include "armature/control/trapezoid.hpp"

namespace armature::control {

/// Why a `Trajectory` did not do what it was asked for.
enum class Refusal {
  kNone,           ///< it did
  kWrongNumber,    ///< not one number for each axis
  kNotFinite,      ///< a position, velocity or time is not a finite number
  kOutsideLimits,  ///< a target is outside the position limits of its axis
  kNegativeTime,
  kTooFast,       ///< the limits allow it in a longer time, or a slower jog: the answer has which
  kTooLong,       ///< it would take more than `Trajectory::kLongest_s`
  kUnderWay,      ///< a motion or a stop is not over yet
  kNoPosition,    ///< where the axes are was never said: hold() comes first
  kZeroVelocity,  ///< a jog has no direction
  kAtLimit,       ///< a jog goes towards the limit at which its axis is
};

/// A few words for a message, such as "a target is outside the limits of its axis".
/// @rt nonblocking, no allocation
std::string_view to_text(Refusal refusal);

/// Moves several axes from rest to rest with trapezoidal velocities. All start and end together:
/// each axis takes its shortest motion, and all are scaled in time to the slowest (paper 2, section
/// 4.1, nAxesGenerator), or to the longer time that was asked for. What is refused changes nothing.
/// One thread uses it.
class Trajectory {
 public:
  static constexpr std::size_t kNoAxis = static_cast<std::size_t>(-1);
  static constexpr double kLongest_s = 1e9;

  /// Limits of one axis, in its unit (rad or m) and seconds.
  struct Axis {
    double max_velocity = 0.0;                                ///< > 0
    double max_acceleration = 0.0;                            ///< > 0
    double lower = -std::numeric_limits<double>::infinity();  ///< < upper
    double upper = std::numeric_limits<double>::infinity();
  };
  /// The axes that move together.
  struct Config {
    std::vector<Axis> axes;  ///< at least one
  };

  /// Whether a motion was accepted, and if not, why.
  struct [[nodiscard]] Answer {
    Refusal refusal = Refusal::kNone;
    std::size_t axis = kNoAxis;  ///< the first one it is about, if it is about one
    double shortest_s = 0.0;     ///< of a motion's kTooFast: the time that the limits allow
    double fastest = 0.0;        ///< of a jog's kTooFast: the velocity that the limits allow

    bool accepted() const { return refusal == Refusal::kNone; }
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<void> check(const Config& config);
  static base::Result<Trajectory> make(const Config& config);

  /// Rests at `positions` from now on, whatever went on: what was measured, before a robot is armed
  /// (resetPosition). Refuses kWrongNumber and kNotFinite; positions outside the limits are facts.
  /// @rt nonblocking, no allocation, O(axes)
  Answer hold(std::span<const double> positions);

  /// What is wrong with a motion wherever it begins: refuses kWrongNumber, kNotFinite,
  /// kOutsideLimits and kNegativeTime.
  /// @rt nonblocking, no allocation, O(axes)
  Answer check_request(std::span<const double> positions, double time_s) const;

  /// Begins a motion from where the axes rest.
  /// @param positions  the target, one per axis
  /// @param time_s     what the motion takes; 0: the shortest time that the limits allow
  /// @param limit      looked at along the motion, or nullptr
  /// @return any refusal of the enumeration
  /// @rt nonblocking, no allocation, O(axes)
  Answer move_to(std::span<const double> positions, double time_s, MotionLimit* limit = nullptr);

  /// Begins to move one axis from where all rest to its limit, with its largest acceleration up to
  /// `velocity`: who lets go of it says stop().
  /// @param axis      < axes()
  /// @param velocity  in the axis' unit and seconds, not 0; its sign is the direction
  /// @param limit     looked at along the motion, or nullptr
  /// @return kNotFinite, kZeroVelocity, kTooFast, kAtLimit, kUnderWay, kNoPosition, kTooLong
  /// @rt nonblocking, no allocation, O(axes)
  Answer jog(std::size_t axis, double velocity, MotionLimit* limit = nullptr);

  /// Brakes all axes evenly from where the motion is now, to hold where they come to rest. They end
  /// together, with the slowest; none leaves its limits or passes its target. Nothing happens at
  /// rest, or if it is stopping already.
  /// @rt nonblocking, no allocation, O(axes)
  void stop();

  /// The same from a measured state, whatever went on. Axes that would leave their limits end
  /// sooner than the others, with their largest acceleration if they must. Refuses kWrongNumber,
  /// kNotFinite and kTooLong.
  /// @param velocities  one per axis, also above the limit
  /// @rt nonblocking, no allocation, O(axes)
  Answer stop_from(std::span<const double> positions, std::span<const double> velocities);

  /// Goes on by `period`, >= 0; afterwards positions(), velocities() and accelerations() are those
  /// of the new time.
  /// @rt nonblocking, no allocation, O(axes)
  void step(base::Duration period);

  /// The present motion at any of its times; after its end, where it rests.
  /// @param axis  < axes()
  /// @rt nonblocking, no allocation
  MotionSample sample(std::size_t axis, double time_s) const { return motions_[axis].at(time_s); }

  bool under_way() const { return elapsed_s() < duration_s_; }
  double elapsed_s() const { return static_cast<double>(elapsed_.count()) * 1e-9; }
  double duration_s() const { return duration_s_; }  ///< of the present or last motion
  double remaining_s() const { return under_way() ? duration_s_ - elapsed_s() : 0.0; }
  double progress() const { return under_way() ? elapsed_s() / duration_s_ : 1.0; }  ///< 0..1
  std::size_t axes() const { return axes_.size(); }

  /// One number per axis; valid until the trajectory is gone.
  std::span<const double> positions() const { return positions_; }
  std::span<const double> velocities() const { return velocities_; }
  std::span<const double> accelerations() const { return accelerations_; }

 private:
  explicit Trajectory(const Config& config);

  Answer check_finite(std::span<const double> numbers) const;
  Answer check_target(std::span<const double> positions) const;
  double shortest_s(std::size_t axis, double distance) const;
  double ramp_share(std::size_t axis, double distance) const;
  double shortest_brake_s(std::size_t axis, double velocity) const;
  double brake_s(std::size_t axis, double velocity, double room, double together_s) const;
  double room_to_limit(std::size_t axis, double position, double velocity) const;
  void shape(std::span<const double> positions, double duration_s);
  double most_used(MotionLimit& limit, double duration_s);
  void begin(double duration_s);
  void sample_all();

  std::vector<Axis> axes_;
  std::vector<Trapezoid> motions_;
  std::vector<Trapezoid> next_;  ///< of a motion that may be refused
  std::vector<double> next_positions_;
  std::vector<double> next_velocities_;
  base::Duration elapsed_{};
  double duration_s_ = 0.0;
  bool position_known_ = false;
  bool stopping_ = false;
  std::vector<double> positions_;
  std::vector<double> velocities_;
  std::vector<double> accelerations_;
};

}  // namespace armature::control
