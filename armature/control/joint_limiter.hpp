// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::control {

/// A command for a drive that a JointLimiter has let through: the kind that hardware takes. Nothing
/// else makes one that could move a joint, so no way to the hardware leads around a limiter.
template <typename Quantity>
class LimitedCommand {
 public:
  constexpr LimitedCommand() = default;
  constexpr operator double() const { return value_; }  // NOLINT: reads like the number it is
  /// For hardware that counts the other way.
  constexpr LimitedCommand operator-() const { return LimitedCommand(-value_); }
  /// For hardware that counts in other units, and from elsewhere.
  constexpr LimitedCommand scaled(double ratio) const { return LimitedCommand(value_ * ratio); }
  constexpr LimitedCommand counted(double ratio, double from) const {
    return LimitedCommand(value_ * ratio + from);
  }

 private:
  friend class JointLimiter;
  constexpr explicit LimitedCommand(double value) : value_(value) {}

  double value_ = Quantity::kNone;
};

/// Of a LimitedCommand that nobody made, an effort: none.
struct EffortQuantity {
  static constexpr double kNone = 0.0;
};
/// The same of a velocity: rest.
struct VelocityQuantity {
  static constexpr double kNone = 0.0;
};
/// The same of a position: there is none that moves nothing.
struct PositionQuantity {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

/// A voltage, a current, a torque.
using LimitedEffort = LimitedCommand<EffortQuantity>;
using LimitedVelocity = LimitedCommand<VelocityQuantity>;
using LimitedPosition = LimitedCommand<PositionQuantity>;

/// What has to be shown to whoever switches a motor on or opens a brake: that the joint's limiter
/// is armed. Nothing else makes one that is valid, so energy gets into a joint by arming only.
class DrivePermit {
 public:
  constexpr DrivePermit() = default;
  constexpr explicit operator bool() const { return armed_; }

 private:
  friend class JointLimiter;
  constexpr explicit DrivePermit(bool armed) : armed_(armed) {}

  bool armed_ = false;
};

/// The last step before the hardware of one joint. A component uses the function of its kind of
/// command, once a period.
///
/// Positions and velocities: with v the velocity during one period T, no step changes v by more
/// than max_acceleration T, and |v| stays below max_velocity and below what can be brought to rest,
/// by steps of max_acceleration T, before `lower` and `upper`; that is v^2 / (2 a) of the velocity
/// at the sample, exactly. A command that keeps to this is passed unchanged; after one that does
/// not, the output catches up as fast as it may, without overshooting one that rests or moves
/// evenly.
///
/// Efforts: a limiter has no model of the robot, so it cannot promise a motion. It takes away what
/// drives the joint on where the measured velocity could no more be stopped before the limit, or is
/// above max_velocity; an effort that brakes is passed.
///
/// Nothing is passed before arm(). One thread uses it.
class JointLimiter {
 public:
  /// Positions in the unit of the joint (rad or m) and seconds; efforts in that of the actuator.
  struct Config {
    double lower = -std::numeric_limits<double>::infinity();  ///< < upper
    double upper = std::numeric_limits<double>::infinity();
    double max_velocity = 0.0;      ///< > 0
    double max_acceleration = 0.0;  ///< > 0; the joint must be able to brake with it
    double max_effort = 0.0;        ///< > 0
    base::Duration period{};        ///< between two steps; > 0
    /// While the rate limit lasts, |effort| grows by at most `effort_rate` in a second. It lasts
    /// for `arming_time` and then until the effort has caught up with the command, so it never
    /// jumps.
    base::Duration arming_time{};  ///< >= 0; 0: no rate limit
    double effort_rate = 0.0;      ///< > 0 if there is an arming time
  };

  /// How the joint moves.
  struct Measured {
    double position = 0.0;
    double velocity = 0.0;
  };

  /// What became of a command.
  enum class Status {
    kPassed,     ///< the value is the command
    kClipped,    ///< the value is the nearest one that is safe; counts() says why
    kNotFinite,  ///< the command or what it was to be judged by is no number: brakes, or effort 0
    kDisarmed,   ///< nothing is commanded: the measured position, velocity 0, effort 0
  };

  /// What may be sent, always finite, and what became of the command.
  template <typename Command>
  struct Step {
    Command value;
    Status status = Status::kPassed;
  };
  using LimitedStep = Step<LimitedEffort>;

  /// Steps whose command was clipped, for each limit that was the reason; one step may count for
  /// several.
  struct Counts {
    std::uint64_t position = 0;  ///< `lower` or `upper`, with the stopping distance
    std::uint64_t velocity = 0;
    std::uint64_t acceleration = 0;
    std::uint64_t effort = 0;
    std::uint64_t effort_rate = 0;  ///< after arming
    std::uint64_t not_finite = 0;
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<void> check(const Config& config);
  static base::Result<JointLimiter> make(const Config& config);

  /// From now on commands are passed. The reference begins at rest where the joint is, the effort
  /// at 0, so that arming moves nothing, also outside the position limits.
  /// @param effort  that holds the joint: what grows begins there
  /// @return false, and it stays disarmed, if an argument is not finite
  /// @rt nonblocking, no allocation
  bool arm(const Measured& measured, double effort = 0.0);

  /// The effort may grow as fast as it likes from now on: it is what holds the joint.
  /// @rt nonblocking, no allocation
  void end_rate_limit() { rate_limited_ = false; }

  /// @rt nonblocking, no allocation
  void disarm() { armed_ = false; }
  bool armed() const { return armed_; }
  /// Valid while it is armed.
  DrivePermit permit() const { return DrivePermit(armed_); }

  /// Limits a position reference by what was sent before: to judge it by the measured position
  /// would make it follow a joint that is pushed. What is not finite brakes to rest with
  /// max_acceleration. A joint that was armed outside its limits may stay there or come back, but
  /// not go further out.
  /// @rt nonblocking, no allocation
  Step<LimitedPosition> step_position(const Measured& measured, double command);

  /// Limits a velocity reference by the measured position. What is not finite brakes to rest with
  /// max_acceleration.
  /// @rt nonblocking, no allocation
  Step<LimitedVelocity> step_velocity(const Measured& measured, double command);

  /// Limits an effort, such as a torque or a voltage, by the measured state. What is not finite is
  /// answered by effort 0. A positive effort has to drive the joint towards `upper`.
  /// @rt nonblocking, no allocation
  LimitedStep step_effort(const Measured& measured, double command);

  const Counts& counts() const { return counts_; }
  const Config& config() const { return config_; }

 private:
  struct Range {
    double low = 0.0;
    double high = 0.0;
  };

  explicit JointLimiter(const Config& config);

  Step<double> position_within(const Measured& measured, double command);
  Step<double> velocity_within(const Measured& measured, double command);
  double velocity_towards(double target) const;
  double fastest_within(double room) const;
  double within_motion(const Range& room, double velocity) const;
  double within_acceleration(double velocity) const;
  void count_reasons(const Range& room, double velocity);
  Step<double> brake();
  void move_to(double position);
  double effort_within_rate(double effort);
  double effort_within_motion(const Measured& measured, double effort);

  Config config_;
  double period_s_;
  double velocity_step_;  ///< the largest change of velocity in one period
  bool armed_ = false;
  bool rate_limited_ = false;
  base::Duration armed_for_{};
  double position_ = 0.0;      ///< the last reference
  double velocity_ = 0.0;      ///< during the last period
  double last_command_ = 0.0;  ///< a position within the limits
  double effort_ = 0.0;
  Counts counts_;
};

}  // namespace armature::control
