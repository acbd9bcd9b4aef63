// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/component/author.hpp"
#include "armature/control/taught/taught_player.hpp"
#include "armature/controllers/axes_generator/axes_generator_online.hpp"
#include "armature/controllers/base/changes.hpp"

namespace armature::controllers {

/// nAxesGeneratorOnline that also plays what a hand taught (control::TaughtPlayer), and leaves the
/// reference to the hand while it teaches. The Teacher among its superiors has names and files.
///
/// `playPath` moves smoothly to the begin of a path, from wherever the axes are, and follows it as
/// near to the wanted speed as max_vel, max_acc and a peer's motionLimitUsed allow; the log says
/// where that is slower. Refused with the reason, and nothing moves: another number of axes, a
/// number that is not finite, a path that leaves the limits or is longer than max_duration, a speed
/// that is not from 0.01 to 10, a motion under way, a robot that is not armed. Cancel and Stop
/// brake on the path; Settle, Disarm and resetPosition end it as they end any motion.
///
/// `playFromHere` plays a path that begins where the axes rest, at once; one that begins elsewhere,
/// or while they move, is refused. `jogPath` does the same as long as somebody renews it by
/// `keepJoggingPath`: 150 ms of the application's clock after the last renewal it brakes on the
/// path, as `jog` does. A renewal never begins one, and goes on with none that brakes.
///
/// With the application's Modes among its peers, and while the mode `hand_mode` is the present one,
/// the desired position is the measured one, anew in each cycle, and no motion begins: whatever
/// mode comes next takes over where the hand has left the robot.
/// @rt nonblocking, no allocation, O(axes); playPath O(points)
class AxesGeneratorTaught final : public AxesGeneratorOnline {
 public:
  using AxesGeneratorOnline::AxesGeneratorOnline;

 private:
  using ModeName = base::FixedText<63>;  ///< as exec::Modes has it
  using PlayCommand = component::Command<const Vector&, double>;

  component::Outcome on_start() override;
  void on_update() override;
  component::Outcome set_up() override;
  component::Outcome may_begin() override;
  void reset_position() override;
  void end_commands(std::string_view why) override;
  void settle() override;
  void stop() override;

  component::Outcome may_take_axes();
  component::Outcome begin_path(const Vector& points, double speed);
  component::Outcome begin_from_here(const Vector& points, double speed) {
    return play_from_here(play_from_here_, points, speed);
  }
  component::Outcome play_from_here(const PlayCommand& command, const Vector& points, double speed);
  component::Outcome begin_jog_path(const Vector& points, double speed);
  bool keep_jogging_path();
  component::Outcome may_play(const PlayCommand& command, const Vector& points, double speed);
  component::Outcome begun(const control::TaughtPlayer::Answer& answer, double speed);
  /// One of the commands that play, `but` one.
  bool is_playing(const PlayCommand* but = nullptr) const;
  control::OnlineTrajectory::State now();
  component::Reason refusal_of(const control::TaughtPlayer::Answer& answer) const;
  bool played() { return !player_->under_way(); }
  void brake() { player_->stop(); }
  void on_switched(const ModeName& mode);
  void play_on();
  void tell_begin();
  void take_over();
  void follow_hand();

  component::Property<double> longest_{this, "max_duration",
                                       60.0, "of a taught motion, in its own time",
                                       "s",  component::range(0.1, 3600.0)};
  component::Property<std::string> hand_mode_{this, "hand_mode", "weightless",
                                              "mode in which a hand leads the robot"};
  component::Attribute<bool> led_{this, "led_by_hand", false,
                                  "the reference follows the hand, and no motion begins"};
  component::EventHandler<ModeName> switched_{this,
                                              "Switched",
                                              component::serve<&AxesGeneratorTaught::on_switched>,
                                              "another mode runs",
                                              component::optional,
                                              component::leads_to_nothing()};
  PlayCommand play_{this,
                    "playPath",
                    component::serve<&AxesGeneratorTaught::begin_path>,
                    "moves to the begin of a path and plays it; 1 is the speed of the teaching",
                    component::args("control points of all axes, each 40 ms [rad]", "speed"),
                    component::done_when<&AxesGeneratorTaught::played>,
                    component::cancelled_by<&AxesGeneratorTaught::brake>};
  PlayCommand play_from_here_{
      this,
      "playFromHere",
      component::serve<&AxesGeneratorTaught::begin_from_here>,
      "plays a path that begins where the axes rest; 1 is the speed of the teaching",
      component::args("control points of all axes, each 40 ms [rad]", "speed"),
      component::done_when<&AxesGeneratorTaught::played>,
      component::cancelled_by<&AxesGeneratorTaught::brake>};
  PlayCommand jog_path_{
      this,
      "jogPath",
      component::serve<&AxesGeneratorTaught::begin_jog_path>,
      "plays a path that begins where the axes rest as long as keepJoggingPath renews it",
      component::args("control points of all axes, each 40 ms [rad]", "speed"),
      component::done_when<&AxesGeneratorTaught::played>,
      component::cancelled_by<&AxesGeneratorTaught::brake>};
  component::Operation<bool()> keep_jogging_path_{
      this, "keepJoggingPath", component::serve<&AxesGeneratorTaught::keep_jogging_path>,
      "renews jogPath; false: it is not under way, or brakes", component::in_own_thread};
  HeldJog held_;
  Changes longest_changed_{longest_};
  std::optional<control::TaughtPlayer> player_;
  double speed_ = 1.0;  ///< that was asked for
  bool told_ = false;   ///< that the path has begun
};

}  // namespace armature::controllers
