// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/trajectory.hpp"
#include "armature/controllers/axes_generator/generator_of_axes.hpp"
#include "armature/controllers/axes_generator/peers_limit.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/held_jog.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// Moves N axes from rest to rest with trapezoidal velocities that begin and end together (paper 2,
/// section 4.2.4, nAxesGeneratorPos): control::Trajectory. For a periodic activity; writes the
/// three desired vectors in each cycle.
///
/// After a start, also one behind a fault, the desired position is the measured one, and nothing
/// moves before `moveTo`. Refused with the reason, and nothing changes: another number of
/// positions, a target outside the limits, a number that is not finite, a negative time, one in
/// which the limits do not allow the motion, a stop under way, a robot that is not armed (if Arming
/// is a peer), and a moveTo before anything was measured. A peer that offers
/// `motionLimitUsed` limits motions too, such as by the speed of the robot's tip. Cancelling a
/// motion is a smooth deceleration to rest, where it then holds. So is Stop; Settle and Disarm make
/// the measured position the desired one (see Arming). Limits are one number for each axis, or one
/// for all.
///
/// Up to 8 motions wait for the one under way (paper 1, section 2). Each begins where the one
/// before it ended: its shortest time is known then, and it is refused then if its own is shorter.
/// Whatever is wrong with its positions and its time itself is refused at once. Where a motion ends
/// in any other way than done, by cancel, Stop, Settle, Disarm, a stop or a fault, those that wait
/// end too.
///
/// `jog` moves one axis towards its limit while somebody holds on to it: not renewed by
/// `keepJogging` for 150 ms of the application's clock it brakes with the largest acceleration, as
/// it does when it is cancelled. A renewal names the axis and velocity that it is for. It goes on
/// with a jog that is under way and not braking, and begins none: those that come late move
/// nothing. Refused as a motion is, and while a motion or another jog is under way; so is a motion
/// while an axis jogs.
///
/// Paper 2, section 4.2.4, has resetPosition set the desired velocity to zero. In motion that is a
/// step of the reference, which the joints answer with all their voltage. Here the motion is braked
/// from the measured position with the largest acceleration, and the velocity is zero afterwards.
/// @rt nonblocking, no allocation, O(axes)
class AxesGeneratorPos final : public GeneratorOfAxes {
 public:
  using GeneratorOfAxes::GeneratorOfAxes;

 private:
  component::Outcome on_configure() override { return set_up(); }
  component::Outcome on_start() override;
  void on_update() override;

  component::Outcome set_up();
  component::Outcome begin_move(const std::vector<double>& positions, double time);
  component::Outcome may_wait(const std::vector<double>& positions, double time) const;
  component::Outcome begin_jog(int axis, double velocity);
  bool keep_jogging(int axis, double velocity);
  void brake_jog_let_go();
  bool arrived() { return !trajectory_->under_way(); }
  void brake() { trajectory_->stop(); }
  void reset_position();
  void begin_anew(const control::Trajectory::Answer& answer, std::string_view why);
  component::Reason refusal_of(const control::Trajectory::Answer& answer,
                               const std::vector<double>& positions, double time) const;
  component::Reason refusal_of_jog(const control::Trajectory::Answer& answer, int axis,
                                   double velocity) const;
  std::optional<std::size_t> hold_at(const Vector& measured) override;
  void settle() override;
  void stop() override;

  static constexpr std::size_t kMostWaiting = 8;

  component::Command<const Vector&, double> move_to_{
      this,
      "moveTo",
      component::serve<&AxesGeneratorPos::begin_move>,
      "moves all axes to positions in a time; 0: as fast as the limits allow; 8 may wait",
      component::args("positions [rad]", "time [s]"),
      component::done_when<&AxesGeneratorPos::arrived>,
      component::cancelled_by<&AxesGeneratorPos::brake>,
      component::may_wait<&AxesGeneratorPos::may_wait>(kMostWaiting)};
  component::Command<int, double> jog_{
      this,
      "jog",
      component::serve<&AxesGeneratorPos::begin_jog>,
      "moves an axis towards its limit while keepJogging comes at least each 150 ms",
      component::args("axis, from 1", "velocity [rad/s]"),
      component::done_when<&AxesGeneratorPos::arrived>,
      component::cancelled_by<&AxesGeneratorPos::brake>};
  component::Operation<bool(int, double)> keep_jogging_{
      this,
      "keepJogging",
      component::serve<&AxesGeneratorPos::keep_jogging>,
      "goes on with the jog of this axis and velocity; false: none is under way, and none begins",
      component::args("axis, from 1", "velocity [rad/s]"),
      component::in_own_thread};
  component::Operation<void()> reset_position_{
      this, "resetPosition", component::serve<&AxesGeneratorPos::reset_position>,
      "desired := measured; a motion is braked smoothly from there, and its moveTo fails",
      component::in_own_thread};
  Changes changes_{axes_, max_velocity_, max_acceleration_, lower_, upper_};

  std::optional<control::Trajectory> trajectory_;
  PeersLimit peers_limit_{limit_used_};
  HeldJog jogging_;
};

}  // namespace armature::controllers
