// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/control/absolute_position.hpp"
#include "armature/control/arming/arming_sequence.hpp"
#include "armature/control/arming/holding_watch.hpp"
#include "armature/control/following_watch.hpp"
#include "armature/control/joint_limiter.hpp"
#include "armature/control/still_watch.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/joint_command.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/missing_answers.hpp"
#include "armature/controllers/base/sample_watch.hpp"
#include "armature/controllers/base/sampling_period.hpp"
#include "armature/controllers/joint/command_output.hpp"
#include "armature/controllers/joint/homing_settings.hpp"
#include "armature/controllers/joint/joint_model.hpp"
#include "armature/controllers/joint/joint_peer.hpp"
#include "armature/controllers/joint/joint_settings.hpp"
#include "armature/controllers/joint/kept_position.hpp"
#include "armature/controllers/joint/own_homing.hpp"

namespace armature::controllers {

/// A joint, independent of its hardware, which a peer represents (paper 1, section 3.1; what the
/// peer offers is in JointHardware). Signs, ratio and offset are here, and so is the last step
/// before the hardware: every command passes a control::JointLimiter, and the hardware takes
/// nothing else.
///
/// A drive is given voltages, currents or torques, or follows velocities or positions by itself:
/// each way is a model of its own (JointOf), whose ports and limits are called by it. Torques are
/// those of the joint, behind its gear. A drive that follows is watched: a joint that is not where,
/// or as fast as, the drive was told is braked, and faults (control::FollowingWatch); so is one
/// whose position stays the same to the bit while it was told to move (control::StillWatch).
///
/// The hardware tells how far its axis turned (DisplacementSensor), or where it is
/// (PositionSensor); a jump that the joint cannot have made is a fault.
///
/// With `Unit: m` it is a linear axis, which a motor that turns moves by a rack or a spindle: it
/// has m, m/s, m/s^2 and N in place of rad, rad/s, rad/s^2 and Nm, and GearRatio is in m/rad.
///
/// After a start, also one behind a fault, the joint is disarmed: motor off, brake applied, effort
/// 0. Only Arm, an event of the component Arming, changes that, and only if the joint was measured
/// just before. It is held before it is let go (control::ArmingSequence): the effort grows against
/// the closed brake until it has settled, then the brake opens, and a joint that then moves by more
/// than ArmingMotion is braked again and not armed. Without a brake the motor is switched on with
/// the effort that holds. Disarm, a stop, a fault, data that is too old, motorOff and brakeApply
/// disarm it. At Disarm a motor that turns is switched off when it has come to rest, after a second
/// at the latest: with effort 0 it brakes itself, switched off it would coast.
///
/// Hardware that homes by itself does so at the operator's command `home`, of a joint that is
/// disarmed: it alone is let go, and nothing else commands it. Its velocity is watched, and so are
/// the way (no longer than its range) and the time. Its position may jump once: that is what homing
/// is for. At its end, however it ends, the joint is disarmed, so that generators begin at the new
/// position when it is armed. With HomingRequired it is not armed before.
///
/// With another HomingMethod than `drive` the joint homes by itself (OwnHoming): it holds itself
/// and lets go as when it is armed, and moves by a limiter of its own. Where home is it takes over
/// at rest, once its brake is applied. From the moment at which it begins until it has found home
/// nobody knows where it is: it is not armed then, unless the operator says where it is.
///
/// Between Rest and Motion, events of Arming, the armed joint is to stand: beyond what the
/// properties Holding... say it is braked, and faults (control::HoldingWatch).
///
/// With `autosave` it begins where the run before has left it, and is not armed before the operator
/// has confirmed that it is there (KeptPosition).
/// @rt nonblocking but for the hardware's answers, no allocation
class Joint : public component::Component,
              public DrivesJoints,
              public PassesSamples,
              public component::Keeps {
 public:
  /// Whose drive is given voltages.
  explicit Joint(std::string name) : Joint(std::move(name), JointCommand::kVoltage) {}

  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;
  std::vector<const component::InputPortBase*> samples_behind(
      const component::OutputPortBase& /*output*/) const override {
    return {&face(displacement_sensor_), &face(position_sensor_)};
  }
  component::Keeping& keeping() override { return kept_; }

 protected:
  Joint(std::string name, JointCommand command)
      : Component(std::move(name)), way_(command), names_(names_of(command)) {}

 private:
  enum class Phase {
    kDisarmed,
    kTakingLoad,  ///< the brake is closed, or the motor off without one
    kLetGo,       ///< and watched
    kArmed,
    kHoming,  ///< it or its hardware moves by itself, and nothing else commands it
  };

  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_stop() override;

  /// What happened to its position, for who has to say why it is not armed.
  enum class Unknown {
    kNothing,
    kBegunToHome,  ///< and not found home
    kOtherZero,    ///< than it was homed with
  };

  component::Outcome set_up();
  component::Outcome count_from_zero();
  double max_effort() const;
  control::AbsolutePosition::Config absolute_sensor() const;
  control::JointLimiter::Config limits() const;
  control::ArmingSequence::Config arming_steps() const;
  control::HoldingWatch::Config holding() const;
  control::StillWatch::Config still() const;

  // Measuring.
  void on_sample();
  bool is_in_time();
  void on_displacement(double of_motor);
  void on_position(double of_motor);
  void moved(double displacement, double to);
  void on_index(bool closed) {
    index_closed_ = closed;
    index_.write(closed);
  }
  double sensor_read();
  bool measured_lately() const;

  // Driving.
  void on_act();
  double effort_of(double command) const { return is_effort(way_) ? command : 0.0; }
  bool apply(double command);
  control::JointLimiter::Status limit_and_write(double command);
  void stand_still();

  // Arming: joint_arming.cpp.
  void on_arm();
  void go_on_arming();
  void let_go();
  void be_armed();
  void fail_to_arm(const component::Reason& why);
  component::Reason why_unknown() const;
  component::Reason not_held() const;
  component::Reason moved_before() const;
  component::Reason never_settled() const;

  // Homing: joint_homing.cpp.
  component::Outcome begin_homing();
  component::Outcome may_home() const;
  component::Outcome may_move_to_home() const;
  component::Outcome begin_by_hardware();
  component::Outcome begin_by_itself();
  void be_here();
  bool homes_by_hardware() const { return homing_.method() == HomingMethod::kDrive; }
  bool begin_search(control::DrivePermit permit);
  void follow_own_homing(double displacement);
  void let_go_to_home();
  bool switch_on_to_home();
  void look_for_home();
  void write_homing();
  void be_homed_by_itself();
  void be_at(double position);
  void cancel_homing();
  void follow_homing(double displacement);
  void homing_jumped(double position);
  bool is_homing_watched();
  void be_homed();
  void tell_homed();
  void fail_homing(const component::Reason& why, bool is_fault);
  bool is_homed_enough() {
    return !settings_->homing_required || homed_.get() || hardware_.is_homed();
  }

  // Standing: joint_arming.cpp.
  void watch();
  void watch_drive();
  void fault_still();
  void brake_because(const control::HoldingWatch::Finding& finding);
  void on_rest();
  void on_motion() { watch_->move(); }
  void note_sinking(double displacement);

  // Disarming: joint_arming.cpp.
  bool disarm();
  bool brake_at_once();
  bool switch_off();
  bool cut_power();
  void cut_power_at_rest();
  bool motor_on(control::DrivePermit permit) {
    return limiter_->armed() && hardware_.actuator_on(permit);
  }
  bool brake_apply() { return disarm(); }
  bool brake_release(control::DrivePermit permit);

  const JointCommand way_;  ///< its drive is commanded in
  const JointCommandNames& names_;

  component::Property<std::string> peer_name_{
      this, "PeerName", "", "the component of the joint's hardware", "", component::mandatory};
  component::Property<bool> brake_{this, "Brake", false, "the joint has a brake"};
  component::Property<bool> sampler_{this, "Sampler", true, "follows the events Sample and Act"};

  JointUnits units_{this, way_};
  JointProperties settings_{this, way_, units_};
  SamplingPeriod period_{this};

  HomingProperties homing_{this, way_, units_, settings_};
  OwnHoming own_{way_, homing_, settings_};

  JointModel model_{this, settings_, way_};
  KeptPosition kept_{this, settings_};

  JointPeer hardware_{this, peer_name_, brake_};
  component::EventHandler<> sample_handler_{
      this,
      "Sample",
      component::serve<&Joint::on_sample>,
      "reads the sensors",
      component::only_if(sampler_),
      component::leads_to("Displacement", "Position", "Index")};
  component::EventHandler<> act_handler_{this,
                                         "Act",
                                         component::serve<&Joint::on_act>,
                                         "applies the latest command",
                                         component::only_if(sampler_),
                                         component::leads_to(names_.actuator)};
  component::EventHandler<> arm_handler_{this, "Arm", component::serve<&Joint::on_arm>,
                                         "held by the motor, then let go",
                                         component::leads_to("Armed", names_.actuator)};
  component::EventHandler<> disarm_handler_{this, "Disarm", component::serve<&Joint::disarm>,
                                            "effort 0, brake applied, motor off",
                                            component::leads_to("Armed", names_.actuator)};
  component::EventHandler<> rest_handler_{this,
                                          "Rest",
                                          component::serve<&Joint::on_rest>,
                                          "the armed joint is to stand from now on",
                                          component::optional,
                                          component::leads_to_nothing()};
  component::EventHandler<> motion_handler_{this,
                                            "Motion",
                                            component::serve<&Joint::on_motion>,
                                            "it may move from now on",
                                            component::optional,
                                            component::leads_to_nothing()};
  component::OperationCaller<void(const ComponentName&, const component::Reason&)> not_armed_{
      this, "notArmed", "says why a joint does not arm", component::optional};

  component::InputPort<double> displacement_sensor_{
      this,
      "DisplacementSensor",
      "of the motor's axis",
      "rad",
      component::on_data<&Joint::on_displacement>,
      component::may_stay_open,
      component::leads_to("Displacement", "Position", "Armed", names_.actuator)};
  component::InputPort<double> position_sensor_{
      this,
      "PositionSensor",
      "where the motor's axis is",
      "rad",
      component::on_data<&Joint::on_position>,
      component::may_stay_open,
      component::leads_to("Displacement", "Position", "Armed", names_.actuator)};
  component::InputPort<bool> index_sensor_{this,
                                           "IndexSensor",
                                           "the index switch is closed",
                                           "",
                                           component::on_data<&Joint::on_index>,
                                           component::leads_to("Index")};
  component::InputPort<double> command_{this,
                                        names_.command,
                                        "to apply at Act; may stay open without Sampler",
                                        "",
                                        component::unit_of(units_.command()),
                                        component::max_age(kMaxAge),
                                        component::may_stay_open};
  CommandOutput command_output_{this, way_};
  component::OutputPort<double> displacement_{this, "Displacement", "since the sample before", "",
                                              component::unit_of(units_.position())};
  component::OutputPort<double> position_{this, "Position", "of the joint", "",
                                          component::unit_of(units_.position())};
  component::OutputPort<bool> index_{this, "Index", "the index switch is closed"};
  component::OutputPort<bool> armed_{this, "Armed", "efforts are passed"};

  component::Operation<bool(control::DrivePermit)> motor_on_{this,
                                                             "motorOn",
                                                             component::serve<&Joint::motor_on>,
                                                             "switches the motor on",
                                                             component::args("permit"),
                                                             component::in_own_thread};
  component::Operation<bool()> motor_off_{this,
                                          "motorOff",
                                          component::serve<&Joint::switch_off>,
                                          "disarms, and switches the motor off",
                                          component::in_own_thread,
                                          component::in_any_state};
  component::Operation<bool(double)> motor_set_{
      this,
      "motorSet",
      component::serve<&Joint::apply>,
      "applies a command until the next; false if the limiter did not pass it as it is",
      component::args("command"),
      component::in_own_thread};
  component::Operation<double()> read_sensor_{
      this, "sensorRead", component::serve<&Joint::sensor_read>,
      "has the sensors read, and returns the displacement; nan if none came meanwhile",
      component::in_own_thread};
  component::Operation<bool()> brake_apply_{this,
                                            "brakeApply",
                                            component::serve<&Joint::brake_apply>,
                                            "disarms, and applies the brake; with Brake only",
                                            component::in_own_thread,
                                            component::in_any_state,
                                            component::only_if(brake_)};
  component::Operation<bool(control::DrivePermit)> brake_release_{
      this,
      "brakeRelease",
      component::serve<&Joint::brake_release>,
      "releases the brake; false while disarmed; with Brake only",
      component::args("permit"),
      component::in_own_thread,
      component::only_if(brake_)};

  component::Command<> home_{
      this,
      "home",
      component::serve<&Joint::begin_homing>,
      "the disarmed joint, or its hardware, moves by itself to find its position; disarmed then",
      component::by_operator,
      component::cancelled_by<&Joint::cancel_homing>};

  component::Attribute<bool> homed_{this, "homed", false, "it has homed by itself since its start"};
  component::Attribute<double> arming_moved_{
      this, "arming_moved",
      0.0,  "by how much it moved when it was armed last, or failed to",
      "",   component::unit_of(units_.position())};
  component::Attribute<double> sunk_{
      this, "sunk",
      0.0,  "by how much it moved since it was disarmed, against its brake",
      "",   component::unit_of(units_.position())};
  component::Attribute<int> clipped_{this, "clipped", 0,
                                     "commands since the configuration that the limiter changed"};

  Changes changes_{settings_, homing_, period_.property()};
  const component::Component* arming_ = nullptr;  ///< who lets it move, and could take that back
  std::optional<control::JointLimiter> limiter_;
  std::optional<control::ArmingSequence> sequence_;
  std::optional<control::HoldingWatch> watch_;
  std::optional<control::AbsolutePosition> absolute_;
  control::FollowingWatch following_;
  control::StillWatch still_;
  Phase phase_ = Phase::kDisarmed;
  double commanded_ = 0.0;  ///< last, whatever became of it
  double sent_ = 0.0;       ///< of it, last, in the unit of the command
  double way_told_ = 0.0;   ///< since the last sample, of a drive that follows by itself
  bool passed_ = false;     ///< it is what was commanded
  control::JointLimiter::Measured measured_;
  SampleWatch intervals_;
  base::Time started_{};
  base::Time measured_at_{};
  bool measured_since_start_ = false;
  bool told_of_sinking_ = false;
  bool off_at_rest_ = false;  ///< disarmed, but the motor is still on
  base::Time disarmed_at_{};
  base::Time homing_since_{};
  double homing_way_ = 0.0;      ///< by which it has moved, with its sign
  bool homing_jumped_ = false;   ///< its position became new
  bool looks_for_home_ = false;  ///< by itself, and was let go
  Unknown unknown_ = Unknown::kNothing;
  bool is_found_ = false;   ///< it was homed: its zero is not the one that it was set to
  bool homed_now_ = false;  ///< and its command ends with the next sample
  bool index_closed_ = false;
  double sensor_ratio_ = 1.0;       ///< motion of the joint for one of the motor
  double rest_ = 0.0;               ///< [rad/s or m/s]; what is slower rests, or is noise
  double effort_ratio_ = 1.0;       ///< effort of the motor for one of the joint
  double displacement_read_ = 0.0;  ///< since sensorRead was called last [rad], or nan
  JointZero zero_;                  ///< that it was set to
};

/// A joint whose drive is commanded so.
template <JointCommand kCommand>
class JointOf final : public Joint {
 public:
  explicit JointOf(std::string name) : Joint(std::move(name), kCommand) {}
};

}  // namespace armature::controllers
