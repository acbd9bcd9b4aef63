// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/online/online_trajectory.hpp"
#include "armature/controllers/axes_generator/generator_of_axes.hpp"
#include "armature/controllers/axes_generator/peers_limit.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/held_jog.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// Moves N axes from any motion to any target with limited jerk, together and as fast as the limits
/// allow: control::OnlineTrajectory. It takes the place of nAxesGeneratorPos, whose ports it has,
/// and its `moveTo`; for a periodic activity; writes the three desired vectors in each cycle.
///
/// After a start, also one behind a fault, the desired position is the measured one, and nothing
/// moves before `moveTo` or `follow`. Refused with the reason, and nothing changes: another number
/// of positions, a target outside the limits, a number that is not finite, a negative time, one in
/// which the limits do not allow the motion, a robot that is not armed (if Arming is a peer), and a
/// command before anything was measured. A motion may begin while the axes still brake.
///
/// `changeTarget` redirects the moveTo that is under way, without a stop. `follow` goes to what the
/// reference ports say, anew in each cycle, until it is cancelled; a reference that is not
/// admissible is not followed: the motion to the one before it goes on, `refused_references` counts
/// it. Where nothing new came for 100 ms, or as long as the connection says, the axes brake and
/// `follow` fails: whoever sends references sends them again and again, also at rest.
///
/// Up to 8 motions wait for the one under way, as those of nAxesGeneratorPos do. Cancelling and
/// Stop brake each axis as fast as its limits allow, and hold where it comes to rest; Settle and
/// Disarm make the measured position the desired one (see Arming). `resetPosition` brakes from the
/// measured position with the desired velocity and acceleration. Limits are one number for each
/// axis, or one for all.
///
/// A peer that offers `motionLimitUsed` limits motions too, such as by the speed of the robot's
/// tip: a motion that would exceed it is planned slower. Stops brake each axis by itself, and are
/// not slowed for it. `jog` and `keepJogging` are those of nAxesGeneratorPos; a jog may begin while
/// the axes still brake.
/// @rt nonblocking, no allocation, O(axes)
class AxesGeneratorOnline : public GeneratorOfAxes {
 public:
  using GeneratorOfAxes::GeneratorOfAxes;

 protected:
  component::Outcome on_configure() override { return set_up(); }
  component::Outcome on_start() override;
  void on_update() override;
  std::optional<std::size_t> hold_at(const Vector& measured) override;
  void settle() override;
  void stop() override;

  /// What follows from the properties.
  virtual component::Outcome set_up();
  /// Whether a motion may begin.
  virtual component::Outcome may_begin();
  virtual void reset_position();
  virtual void end_commands(std::string_view why);
  /// A motion is commanded, and has not ended.
  bool is_commanded() const { return move_to_.active() || follow_.active() || jog_.active(); }
  void step_to_now();
  control::OnlineTrajectory& trajectory() { return *trajectory_; }
  const control::OnlineTrajectory::Config& limits() const { return limits_; }
  /// What a peer limits, or nullptr.
  control::MotionLimit* peers_limit() { return peers_limit_.where_bound(); }

 private:
  using Answer = control::OnlineTrajectory::Answer;

  component::Outcome begin_move(const Vector& positions, double time_s);
  component::Outcome may_wait(const Vector& positions, double time_s) const;
  component::Outcome begin_jog(int axis, double velocity);
  bool keep_jogging(int axis, double velocity);
  bool change_target(const Vector& positions);
  component::Outcome begin_follow();
  void follow_reference();
  Answer go_to(const control::OnlineTrajectory::State& target, double time_s);
  bool arrived() { return !trajectory_->under_way(); }
  void brake() { trajectory_->stop(); }
  component::Reason refusal_of(const Answer& answer, const Vector& positions, double time_s) const;
  component::Reason refusal_of_jog(const Answer& answer, int axis, double velocity) const;

  static constexpr std::size_t kMostWaiting = 8;

  component::Property<Vector> max_jerk_{
      this, "max_jerk",
      {},   "largest jerk of each axis, > 0; none: that which reaches max_acc in 0.1 s",
      "",   component::unit_of(units_.jerk())};
  component::Attribute<int> refused_references_{
      this, "refused_references", 0, "references since the start that were not followed"};
  component::InputPort<Vector> reference_{this,
                                          "nAxesReferencePosition",
                                          "where each axis is to be, for follow",
                                          "",
                                          component::size_of(axes_),
                                          component::max_age(kMaxAge, component::Reaction::kHold),
                                          component::on_lost(component::Reaction::kHold),
                                          component::may_stay_open,
                                          component::unit_of(units_.position())};
  component::InputPort<Vector> reference_velocity_{
      this,
      "nAxesReferenceVelocity",
      "how fast each axis is to be there; written before the position; not connected: at rest",
      "",
      component::unit_of(units_.velocity()),
      component::size_of(axes_),
      component::max_age(kMaxAge, component::Reaction::kHold),
      component::on_lost(component::Reaction::kHold),
      component::may_stay_open};
  component::Command<const Vector&, double> move_to_{
      this,
      "moveTo",
      component::serve<&AxesGeneratorOnline::begin_move>,
      "moves all axes to positions in a time; 0: as fast as the limits allow; 8 may wait",
      component::args("positions [rad]", "time [s]"),
      component::done_when<&AxesGeneratorOnline::arrived>,
      component::cancelled_by<&AxesGeneratorOnline::brake>,
      component::may_wait<&AxesGeneratorOnline::may_wait>(kMostWaiting)};
  component::Operation<bool(const Vector&)> change_target_{
      this,
      "changeTarget",
      component::serve<&AxesGeneratorOnline::change_target>,
      "redirects the moveTo under way, as fast as the limits allow; false: refused, or none is",
      component::args("positions [rad]"),
      component::in_own_thread};
  component::Command<int, double> jog_{
      this,
      "jog",
      component::serve<&AxesGeneratorOnline::begin_jog>,
      "moves an axis towards its limit while keepJogging comes at least each 150 ms",
      component::args("axis, from 1", "velocity [rad/s]"),
      component::done_when<&AxesGeneratorOnline::arrived>,
      component::cancelled_by<&AxesGeneratorOnline::brake>};
  component::Operation<bool(int, double)> keep_jogging_{
      this,
      "keepJogging",
      component::serve<&AxesGeneratorOnline::keep_jogging>,
      "goes on with the jog of this axis and velocity; false: none is under way, and none begins",
      component::args("axis, from 1", "velocity [rad/s]"),
      component::in_own_thread};
  component::Command<> follow_{
      this, "follow", component::serve<&AxesGeneratorOnline::begin_follow>,
      "goes to nAxesReferencePosition, anew in each cycle, until cancelled",
      component::cancelled_by<&AxesGeneratorOnline::brake>};
  component::Operation<void()> reset_position_{
      this, "resetPosition", component::serve<&AxesGeneratorOnline::reset_position>,
      "desired := measured; a motion is braked smoothly from there, and its command fails",
      component::in_own_thread};
  Changes changes_{axes_, max_velocity_, max_acceleration_, max_jerk_, lower_, upper_};

  control::OnlineTrajectory::Config limits_;
  std::optional<control::OnlineTrajectory> trajectory_;
  /// A stop brakes each axis by itself, off the way of the motion: of 5000 random stops of the WAM,
  /// one passed what its motion used by 6 %. So motions leave a tenth.
  static constexpr double kShareOfMotions = 0.9;
  PeersLimit peers_limit_{limit_used_, kShareOfMotions};
  HeldJog jogging_;
};

}  // namespace armature::controllers
