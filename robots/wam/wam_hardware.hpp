// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/waits_for_operator.hpp"
#include "armature/controllers/base/guarded_bus.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/robot_description.hpp"
#include "armature/controllers/base/sample_watch.hpp"
#include "robots/wam/arm_check.hpp"
#include "robots/wam/driver/cause_search.hpp"
#include "robots/wam/driver/float_gate.hpp"
#include "robots/wam/driver/safety_text.hpp"
#include "robots/wam/driver/wam_driver.hpp"
#include "robots/wam/driver/wam_motion.hpp"
#include "robots/wam/emulator/emulated_link.hpp"
#include "robots/wam/emulator/emulated_operator.hpp"
#include "robots/wam/puck_ports.hpp"
#include "robots/wam/torque_path.hpp"
#include "robots/wam/wam_parameters.hpp"
#include "robots/wam/way_home.hpp"

namespace armature::wam {

/// Of added torques: some ten cycles.
inline constexpr base::Duration kMaxAddedAge = std::chrono::milliseconds(20);

/// What the arm does once the operator has activated it, before it is armed.
enum class AfterActivation : std::uint8_t {
  kHold,        ///< it is held where it is
  kWeightless,  ///< then nothing but its weight is driven, so that a hand may lead it (paper 3)
};
ARMATURE_ENUM(AfterActivation, kHold, kWeightless);

/// The arm (paper 3, OrocosWam): the only component that knows its bus, its pucks and its safety
/// board.
///
/// The first that asks in a cycle, or Sample, has all positions read; torque frames are sent in
/// every cycle, 0 until the operator has activated the arm. Activated, it holds where it is.
/// Armed, `torRefPort` and `torAddPort` are passed, through a TorquePath; a command that stays away
/// for three cycles disarms it, and it holds again; so does what a DrivenWatch finds. Whatever ends
/// the activation disarms it: by the operator's hand, it waits for the next; any other loss is a
/// fault with torques 0 and the pucks idle, which brakes the arm.
///
/// Properties count from the configuration on.
/// @rt no allocation; waits for the pucks' answers, 1.4 ms at most
class WamHardware final : public component::Component,
                          public component::WaitsForOperator,
                          public controllers::DrivesJoints {
 public:
  using Component::Component;

  std::vector<controllers::DrivenJoint> joints_behind(const component::InputPortBase* input,
                                                      const component::Check& check) override;

  /// While the arm is brought to idle.
  base::Duration operators_patience() const override;

  /// For tests that break something: the arm in this process; nullptr on another bus.
  EmulatedLink* emulated() { return emulated_; }
  const WamDriver& driver() const { return *driver_; }
  const TorquePath& torque_path() const { return *path_; }

 private:
  using Vector = std::vector<double>;

  /// Has the pucks braked whatever it is that ends a run: a stop, a fault, an exception.
  class Ending final : public component::Step {
   public:
    explicit Ending(WamHardware& arm) : arm_(arm) { component::Host::add_step(arm, *this, true); }
    void step() override {}
    void halt(std::string_view /*reason*/) override { arm_.make_safe(); }

   private:
    WamHardware& arm_;
  };

  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_cleanup() override;

  // Its configuration.
  void on_check(component::Check& check) const override;
  void check_reference(component::Check& check) const;
  bool is_reference(std::size_t size) const;
  component::Outcome check_period() const;
  component::Outcome set_up_path();
  component::Outcome make_link();
  component::Outcome connect(bool said_at_home);
  component::Outcome guard_arm();

  // The cycle.
  bool get_joint_sensors();
  void on_sample();
  void read_all();
  bool is_in_time();
  void count_lost_answers();
  void drive_or_hold();
  void watch_driven();
  void hold();
  void on_torque(const Vector& torques);
  void refuse_torques(const Vector& torques);
  void on_position(const Vector& reference);
  void send_torques();
  void watch_pucks();

  // wam_hardware_safety.cpp
  bool is_guarded();
  bool supervise();
  void tell_safety_state();
  void note_last_safety_state();
  void look_for_cause(WamFault fault);
  void watch_activation();
  void ask_for_activation();
  void take_out(WamFault fault);
  void leave_service();
  void make_safe();
  void begin_to_float();
  void float_on();
  bool hold_again();
  void end_floating(std::string_view why, TorquePath::Last driven);

  // Whether it may stop.
  double from_home() const;
  component::Reason held();

  // Arming.
  void on_arm();
  void on_rest() { driven_->rest(); }
  void on_motion() { driven_->move(); }
  void on_disarm();
  void disarm(std::string_view why, TorquePath::Last driven = TorquePath::Last::kDiesAway);
  void tell_armed(bool armed);
  bool armed() const { return path_->mode() == TorquePath::Mode::kDriven; }

  // Commands.
  double motion_limit_used(const Vector& positions, const Vector& velocities);
  component::Outcome move_home();
  void cancel_home() { way_home_.cancel(); }
  void follow_home();
  component::Outcome press(void (EmulatedOperator::*key)(), component::Command<>& command);
  component::Outcome estop() { return press(&EmulatedOperator::press_estop, estop_); }
  component::Outcome release_estop() {
    return press(&EmulatedOperator::press_reset, release_estop_);
  }
  component::Outcome shift_idle() { return press(&EmulatedOperator::press_idle, shift_idle_); }
  component::Outcome shift_activate() {
    return press(&EmulatedOperator::press_activate, shift_activate_);
  }
  bool lead_by_hand(const Vector& velocities);
  component::Outcome carry_home() { return press(&EmulatedOperator::carry_home, carry_home_); }

  component::Property<int> joints_{
      this,
      "joints",
      7,
      "4, or 7 with the wrist",
      "",
      component::mandatory,
      component::range(1, 100)};  // so that nobody makes ports for millions, before it is refused
  component::Property<std::string> bus_{
      this, "bus", "emulator",
      "emulator: the arm emulated in this process; virtual:PATH; or an interface such as can0"};
  controllers::RobotDescription description_{this};
  WamParameters parameters_{this};
  controllers::GuardedBus guard_{this};
  ArmCheck arm_check_{this, joints_, bus_, description_, parameters_};
  component::Property<double> idle_patience_{
      this, "idle_patience",
      5.0,  "how long to wait at the configuration for the arm to be brought to idle",
      "s",  component::range(0.0, 900.0)};
  component::Property<AfterActivation> after_activation_{
      this, "after_activation", AfterActivation::kHold,
      "hold: it is held where it is; weightless: once it rests there, and nothing but the weight "
      "of its description holds it, a hand may lead it"};
  component::OperatorsWord at_home_{this, "at_home",
                                    "the operator has put the arm at home: pucks that lost their "
                                    "positions are told them there, by "
                                    "the configuration that follows"};
  component::OperatorsWord held_by_hand_{
      this, "held_by_hand", "the operator holds the arm, whose torques end when it stops"};
  component::Property<bool> emulated_operator_{
      this, "emulated_operator",
      true, "the emulator's operator puts the arm at home, presses Shift+Idle and Shift+Activate",
      "",   component::changeable_while_running};

  component::InputPort<Vector> torque_reference_{
      this,
      "torRefPort",
      "torques for the joints, as the actuators tell them",
      "Nm",
      component::on_data<&WamHardware::on_torque>,
      component::size_of(joints_),
      component::max_age(controllers::kMaxAge, component::Reaction::kHold),
      component::on_lost(component::Reaction::kHold),
      component::leads_to("Armed")};
  component::InputPort<Vector> added_torques_{
      this,
      "torAddPort",
      "torques that are added to those of torRefPort, without the arm's weight; too old they are 0",
      "Nm",
      component::size_of(joints_),
      component::may_stay_open,
      component::max_age(kMaxAddedAge, component::Reaction::kZero),
      component::on_lost(component::Reaction::kZero)};
  component::OutputPort<Vector> control_data_{this, "ControlDataPort",
                                              "torques of the arm's own controller", "Nm",
                                              component::size_of(joints_)};
  component::InputPort<Vector> position_reference_{this,
                                                   "posRefPort",
                                                   "for the arm's own controller: [q1..qN], or "
                                                   "[q1..qN, qd1..qdN] with velocities [rad/s]",
                                                   "rad",
                                                   component::on_data<&WamHardware::on_position>,
                                                   component::on_lost(component::Reaction::kHold),
                                                   component::may_stay_open,
                                                   component::leads_to("ControlDataPort")};
  component::OutputPort<Vector> joints_data_{
      this, "jointsDataPort",
      "[q1..qN, qd1..qdN, tau1..tauN]: positions rad, velocities rad/s, torques Nm", "",
      component::size_of(joints_, 3)};
  component::OutputPort<Vector> sent_torques_{
      this, "sentTorquePort", "of the joints, as they were sent last: after all limits", "Nm",
      component::size_of(joints_)};
  component::OutputPort<SafetyState> board_state_{this, "safetyStatePort",
                                                  "of the board, as it said last"};
  PuckPorts puck_ports_{this, joints_};
  component::OutputPorts<bool> armed_{this, "Armed", joints_, "torques are passed"};
  component::Operation<bool()> get_joint_sensors_{
      this, "getJointSensorsOperation", component::serve<&WamHardware::get_joint_sensors>,
      "has the positions of this cycle read, and writes jointsDataPort", component::in_own_thread};
  component::Operation<double(const Vector&, const Vector&)> motion_limit_used_{
      this, "motionLimitUsed", component::serve<&WamHardware::motion_limit_used>,
      "the share of the tip's fastest speed that joints use which move so; above 1: too fast",
      component::args("positions [rad]", "velocities [rad/s]")};
  component::EventHandler<> sample_{this, "Sample", component::serve<&WamHardware::on_sample>,
                                    "reads, so that the arm is held also if nobody asks",
                                    component::leads_to("Armed")};
  component::Holding holding_{this, component::serve<&WamHardware::held>, sample_};
  component::EventHandler<> arm_{this, "Arm", component::serve<&WamHardware::on_arm>,
                                 "torRefPort is passed from now on", component::leads_to("Armed")};
  component::EventHandler<> disarm_{this, "Disarm", component::serve<&WamHardware::on_disarm>,
                                    "holds the arm where it is", component::leads_to("Armed")};

  component::EventHandler<> rest_{this,
                                  "Rest",
                                  component::serve<&WamHardware::on_rest>,
                                  "the armed arm is to stand from now on",
                                  component::optional,
                                  component::leads_to_nothing()};
  component::EventHandler<> motion_handler_{this,
                                            "Motion",
                                            component::serve<&WamHardware::on_motion>,
                                            "it may move from now on",
                                            component::optional,
                                            component::leads_to_nothing()};

  component::CommandCaller<const Vector&, double> generator_{this, "moveTo", "moves the joints",
                                                             component::optional};
  component::Command<> move_home_{this, "moveHome", component::serve<&WamHardware::move_home>,
                                  "moves the armed arm home, at 0.5 rad/s of all joints together",
                                  component::cancelled_by<&WamHardware::cancel_home>};
  component::Command<> estop_{this, "estop", component::serve<&WamHardware::estop>,
                              "presses the emulated E-stop button", component::in_any_state};
  component::Command<> release_estop_{
      this, "releaseEstop", component::serve<&WamHardware::release_estop>,
      "pulls the emulated E-stop button out", component::in_any_state};
  component::Command<> shift_idle_{this, "shiftIdle", component::serve<&WamHardware::shift_idle>,
                                   "presses Shift+Idle of the emulated pendant",
                                   component::in_any_state};
  component::Command<> shift_activate_{
      this, "shiftActivate", component::serve<&WamHardware::shift_activate>,
      "presses Shift+Activate of the emulated pendant", component::by_operator};
  component::Operation<bool(const Vector&)> lead_by_hand_{
      this,
      "leadByHand",
      component::serve<&WamHardware::lead_by_hand>,
      "a hand moves the emulated arm with these velocities, and lets go; false: there is none",
      component::args("velocities [rad/s]"),
      component::by_operator,
      component::in_own_thread};
  component::Command<> carry_home_{
      this,
      "carryHome",
      component::serve<&WamHardware::carry_home>,
      "the emulated operator carries the arm home, and holds it until it is active",
      component::by_operator,
      component::in_any_state};

  component::Attribute<component::Reason> safety_state_{
      this,
      "safety_state",
      {},
      "what the safety board said last: E-STOP, IDLE or ACTIVATED; and how old that is, if it has "
      "not "
      "said it lately"};
  component::Attribute<double> safety_state_age_{
      this, "safety_state_age", 0.0,
      "since the board said so; as it was when the component stopped", "s"};
  component::Attribute<component::Reason> waits_for_{
      this, "waits_for", {}, "what the operator has to do, and why; empty if nothing"};
  component::Attribute<int> lost_answers_{this, "lost_answers", 0,
                                          "positions since the start that did not come"};
  component::Attribute<int> cycles_without_command_{
      this, "cycles_without_command", 0, "since the start, in which the armed arm got no torques"};
  component::Attribute<int> clipped_{this, "clipped", 0,
                                     "commands since the configuration that a limit changed"};
  component::Attribute<int> refused_{
      this, "refused", 0,
      "commands since the start that were not sent, since a torque was above its limit"};
  component::Attribute<bool> weightless_{this, "weightless", false,
                                         "nothing but its weight is driven: a hand may lead it"};

  const ArmNumbers* numbers_ = nullptr;
  const component::Component* arming_ = nullptr;  ///< who arms it, and could take that back
  std::optional<TorquePath> path_;
  std::optional<StandingWatch> standing_;
  std::optional<DrivenWatch> driven_;
  std::optional<JointController> own_controller_;
  std::optional<FloatGate> float_gate_;
  std::unique_ptr<can::Link> link_;
  EmulatedLink* emulated_ = nullptr;
  std::optional<EmulatedOperator> operator_;  ///< of the emulated arm
  std::optional<WamDriver> driver_;
  std::optional<WamMotion> motion_;
  controllers::SampleWatch watch_;

  Ending ending_{*this};
  base::Time read_at_ = base::Time::min();
  base::Time asked_at_{};                    ///< in that cycle, on the bus's clock
  base::Time followed_ = base::Time::min();  ///< by its own controller; min(): it has no past
  bool positions_lost_ = false;              ///< until it is configured anew
  bool commanded_ = false;                   ///< in this cycle
  int without_command_ = 0;                  ///< cycles in a row
  component::Reason why_without_{};          ///< there are none; empty if none came
  bool idle_seen_ = false;                   ///< since the start
  CauseSearch cause_;
  WayHome way_home_{generator_};
  Vector own_torques_;
  Vector all_torques_;  ///< commanded, with what is added
  Vector sent_;
  Vector data_;
};

}  // namespace armature::wam
