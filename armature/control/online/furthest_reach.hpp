// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "armature/control/online/phased_motion.hpp"

namespace armature::control {

/// How an axis moves at both ends of a motion.
struct MotionEnds {
  double start_velocity = 0.0;
  double start_acceleration = 0.0;
  double end_velocity = 0.0;
  double end_acceleration = 0.0;

  /// The same motion, seen from the other side.
  MotionEnds mirrored() const {
    return {-start_velocity, -start_acceleration, -end_velocity, -end_acceleration};
  }
};

/// The longest distance that an axis can cover in a given duration, from one velocity and
/// acceleration to others, for all durations.
///
/// By the maximum principle (Berscheid and Kroeger 2021, section III) the jerk of this motion is
/// +J, 0, -J, 0, -J, 0, +J: up to a peak of acceleration, down to a trough, and up to the end. The
/// velocities leave one free parameter, and the duration T grows with it. With
///   w0 = v0 - a0^2 / 2J,  wf = vf - af^2 / 2J,  K = J (wf - w0) = peak^2 - trough^2
/// the motion that reaches no limit has d = peak - trough, T = (2d + af - a0) / J and
///   J (J X - C) = d^3 / 4 + J (w0 + wf) d - K^2 / 4d,
///   C = wf af - w0 a0 + (af^3 - a0^3) / 6J.
/// dX/dT is as simple where the acceleration is held at its limit A (trough b):
///   wf + b^2 / J - A b / 2J,
/// so all turning points of X(T) are known in closed form, and each root is bracketed by two.
/// All motions with the same duration form a convex set: every distance between the longest one
/// and that of the mirrored problem can be reached, no other.
class FurthestReach {
 public:
  /// @param ends  within the limits, and able to stay within them
  /// @rt nonblocking, no allocation
  FurthestReach(const JerkLimits& limits, const MotionEnds& ends);

  /// The longest distance in `duration_s`; that of the nearest duration that is possible.
  /// @rt nonblocking, no allocation
  double distance(double duration_s) const { return distance_of(shape_at(duration_s)); }

  /// The first duration from `from_s` on that is possible and covers `distance` at least.
  /// @param tolerance  of the distance, >= 0
  /// @rt nonblocking, no allocation
  double first_duration(double from_s, double distance, double tolerance) const;

  /// Appends the phases of the motion of `duration_s`.
  /// @param sign  -1 mirrors it
  /// @rt nonblocking, no allocation
  void append_to(PhasedMotion& motion, double duration_s, double sign) const;

 private:
  /// What limits the motion: nothing, the acceleration at its peak, that at both, or the velocity.
  enum class Kind { kFree, kPeakHeld, kBothHeld, kCruising };
  /// A range of durations with motions of one kind.
  struct Span {
    Kind kind = Kind::kFree;
    double begin_s = 0.0;
    double end_s = 0.0;
    double first_step = 0.0;  ///< of kFree: peak - trough at the begin and the end
    double last_step = 0.0;
  };
  /// One motion: peak and trough of the acceleration, how long they and the velocity are held.
  struct Shape {
    double peak = 0.0;
    double peak_s = 0.0;
    double cruise_s = 0.0;
    double trough = 0.0;
    double trough_s = 0.0;
  };
  struct Turns {
    std::array<double, 3> times{};
    std::size_t size = 0;
  };

  void list_free_spans(double lowest, double highest);
  void add(const Span& span);
  void add_free(double first_step, double last_step);
  const Span& span_at(double duration_s) const;
  Shape shape_at(double duration_s) const { return shape_in(span_at(duration_s), duration_s); }
  Shape shape_in(const Span& span, double duration_s) const;
  Shape free_shape(double step) const;
  double distance_of(const Shape& shape) const;
  double slope_in(const Span& span, double duration_s) const;
  Turns turns_in(const Span& span, double from_s) const;
  double root_in(const Span& span, double low_s, double high_s, double distance, bool rising) const;
  double first_in(const Span& span, double from_s, double distance, double tolerance) const;

  double rounded() const;
  double root(double difference) const;
  double free_s(double step) const;
  double peak_held_s(double trough) const;
  double both_held_s(double top_velocity) const;
  double step_in(const Span& span, double duration_s) const;
  double trough_at(double duration_s) const;
  double top_velocity_at(double duration_s) const;

  JerkLimits limits_;
  bool reversed_ = false;  ///< seen backward in time, so that K >= 0
  double a0_ = 0.0;
  double af_ = 0.0;
  double w0_ = 0.0;
  double wf_ = 0.0;
  double k_ = 0.0;
  double cubes_ = 0.0;   ///< (af^3 - a0^3) / 6J^2
  double held_s_ = 0.0;  ///< peak_held_s(A)
  Shape cruising_;       ///< that just reaches the velocity limit
  std::array<Span, 7> spans_{};
  std::size_t size_ = 0;
};

}  // namespace armature::control
