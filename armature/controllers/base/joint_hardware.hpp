// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/operators_word.hpp"
#include "armature/controllers/base/joint_command.hpp"
#include "armature/controllers/base/limited_effort.hpp"

namespace armature::controllers {

/// The hardware of one joint, as Joint uses it (paper 1, section 3.1): to be extended by a driver.
///
/// It takes only what a joint's limiter has let through: a LimitedEffort, or, if it says that it
/// does, a LimitedVelocity or a LimitedPosition. Nothing else can be connected to it, and a
/// deployment connects one of them. It switches on and opens its brake for a DrivePermit only,
/// which is what an armed limiter gives; it switches off and brakes for everybody, as long as it is
/// configured. The functions answer false if the hardware did not take or do it, and each runs in
/// real time: nonblocking but for the wait that the hardware's answer is worth, no allocation. One
/// that is switched on and does not take three commands in a row faults. Hardware that does not run
/// is neither switched on nor read, so its joint is not armed.
/// Whenever it stops or faults, also because the joint did: effort 0, brake applied, actuator off.
class JointHardware : public component::Component {
 public:
  /// What its sensor tells: how far the axis turned, where it is, or where it is by a counter that
  /// began anywhere when it was switched on.
  enum class Sensor { kIncremental, kAbsolute, kCounting };

  /// What a joint that homes by itself can find its position by.
  struct HomingSigns {
    bool home_switch = false;    ///< IndexSensor tells of a real one
    bool index_mark = false;     ///< of its encoder; `since_index` tells
    bool bounds_effort = false;  ///< of its drive, as `bound_effort` says
  };

  /// A drive that is given voltages, and whose sensor is an incremental one.
  explicit JointHardware(const std::string& name)
      : JointHardware(name, {JointCommand::kVoltage}, Sensor::kIncremental) {}
  /// @param commands  that it can be given, at least one
  JointHardware(const std::string& name, std::initializer_list<JointCommand> commands,
                Sensor sensor);
  ~JointHardware() override;

  /// Turns that the sensor tells for one of the motor's axis, > 0: 1 if it is of that axis.
  /// @thread configuration only
  virtual double sensor_turns() const { return 1.0; }
  /// Its sensor is of the shaft behind the gear, which it knows by itself.
  /// @thread configuration only
  virtual bool tells_of_shaft() const { return false; }
  /// @thread configuration only
  virtual HomingSigns homing_signs() const { return {}; }
  /// @thread configuration only
  virtual Sensor sensor() const { return sensor_kind_; }

 protected:
  virtual bool actuator_on() = 0;
  virtual bool actuator_off() = 0;
  /// @param effort  to apply from now on [V, A, or Nm at the motor], as commanded() says
  virtual bool actuator_set(control::LimitedEffort effort) = 0;
  /// Of hardware that takes velocities: of the motor's axis from now on [rad/s].
  virtual bool velocity_set(control::LimitedVelocity /*velocity*/) { return false; }
  /// Of hardware that takes positions: where the motor's axis is to be, by PositionSensor [rad].
  virtual bool position_set(control::LimitedPosition /*position*/) { return false; }
  /// Reads the sensors and writes `sensor_` and `index_`.
  virtual bool sensor_read() = 0;
  virtual bool brake_apply() = 0;
  virtual bool brake_release() = 0;
  /// What it was told of its actuator and brake last has been done. Hardware that takes its time
  /// says so; a joint is not armed before, and if it takes longer than a few seconds never.
  virtual bool is_as_told() const { return true; }
  /// Of hardware with an index mark: by how much the axis has turned since it passed the mark, if
  /// it has between the last two readings [rad]; nan if it has not.
  virtual double since_index() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// Of hardware that bounds the effort of a drive that follows velocities or positions.
  /// What the drive gives from now on is at most that, > 0 [Nm at the motor]; infinite: all.
  virtual bool bound_effort(double /*most*/) { return false; }

  /// A sample was lost, and what moved meanwhile with it: where the joint is, is not known until
  /// the operator has looked. It goes on if it is armed, and is not armed again before.
  /// @rt nonblocking, no allocation
  void lose_position() {
    is_exact_ = false;
    homes_exactly_ = false;
    tell_exact();
    position_confirmed_.withdraw();
  }

  /// That of the joint, from before it has the actuator switched on until after it is off: for
  /// hardware that hands it on.
  control::DrivePermit permit() const { return permit_; }

  /// What of `commands` the deployment gives it; the first one before it is connected.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  JointCommand commanded() const;

  /// How far the motor's axis turned since the reading before, or where it is.
  component::OutputPort<double> sensor_;
  component::OutputPort<bool> index_{this, "IndexSensor", "the index switch is closed"};

 private:
  /// Uses up the operator's word, if it is needed.
  bool position_known() {
    end_search();
    const bool known = is_exact_ && !is_doubted_;
    if (!known && position_confirmed_.take()) {
      is_exact_ = true;
      is_doubted_ = false;
    }
    tell_exact();
    return is_exact_ && !is_doubted_;
  }
  /// The joint was given its position, and nobody has looked. A word that was given counts.
  bool doubt_position() {
    is_doubted_ = true;
    tell_exact();
    return true;
  }
  bool position_exact() { return is_exact_; }
  /// The joint looks for its position: what was known of it counts no more until it has found it,
  /// or the operator has looked.
  bool begin_homing(control::DrivePermit permit, double most_effort) {
    if (!runs() || !permit) return false;
    position_confirmed_.withdraw();
    searches_ = true;
    homes_exactly_ = true;
    doubt_position();
    if (!std::isfinite(most_effort)) return true;
    is_bounded_ = true;
    return bound_effort(most_effort);
  }
  /// @return false if a sample was lost on the way there
  bool find_position(control::DrivePermit permit) {
    if (!permit || !homes_exactly_) return false;
    searches_ = false;
    is_exact_ = true;
    is_doubted_ = false;
    tell_exact();
    return true;
  }
  /// Without having found it. What was said of it while it moved is not so any more.
  void end_search() {
    if (searches_) position_confirmed_.withdraw();
    searches_ = false;
  }
  double index_passed() { return since_index(); }
  bool as_told() { return runs() && is_as_told(); }
  void tell_exact() { position_exact_.assign(is_exact_ && !is_doubted_); }

  /// Whatever it is that ends a run: a stop, a fault, an exception.
  class Ending final : public component::Step {
   public:
    explicit Ending(JointHardware& hardware) : hardware_(hardware) {
      component::Host::add_step(hardware, *this, true);
    }
    void step() override {}
    void halt(std::string_view /*reason*/) override {
      component::Host::run(hardware_, component::Host::context(hardware_),
                           [this] { hardware_.make_safe(); });
    }

   private:
    JointHardware& hardware_;
  };

  void make_safe() {
    if (commanded() == JointCommand::kVelocity) velocity_set({});
    if (is_effort(commanded())) actuator_set({});
    brake_apply();
    switch_off();
  }
  bool runs() const { return state() == component::State::kRunning; }
  bool switch_on(control::DrivePermit permit) {
    if (!runs()) return false;
    permit_ = permit;
    if (!permit) return false;
    switched_on_.assign(true);
    return actuator_on();
  }
  bool switch_off() {
    const bool off = actuator_off();
    end_search();
    if (off) switched_on_.assign(false);
    permit_ = {};
    if (is_bounded_) bound_effort(std::numeric_limits<double>::infinity());
    is_bounded_ = false;
    return off;
  }
  bool open_brake(control::DrivePermit permit) { return runs() && permit && brake_release(); }
  bool set_effort(control::LimitedEffort effort) { return runs() && actuator_set(effort); }
  bool read_sensor() { return runs() && sensor_read(); }

  void effort_arrived(control::LimitedEffort effort) { count_refusals(actuator_set(effort)); }
  void velocity_arrived(control::LimitedVelocity velocity) {
    count_refusals(velocity_set(velocity));
  }
  void position_arrived(control::LimitedPosition position) {
    count_refusals(position_set(position));
  }
  void count_refusals(bool taken);

  const Sensor sensor_kind_;

  /// The inputs for what it can be given.
  class CommandInputs;
  std::unique_ptr<CommandInputs> commands_;

  component::Operation<bool(control::DrivePermit)> actuator_on_{
      this,
      "actuatorOn",
      component::serve<&JointHardware::switch_on>,
      "switches the actuator on",
      component::args("permit"),
      component::in_own_thread};
  component::Operation<bool()> actuator_off_{this,
                                             "actuatorOff",
                                             component::serve<&JointHardware::switch_off>,
                                             "switches the actuator off",
                                             component::in_own_thread,
                                             component::in_any_state};
  component::Operation<bool(control::LimitedEffort)> actuator_set_{
      this,
      "actuatorSet",
      component::serve<&JointHardware::set_effort>,
      "applies an effort that a limiter let through",
      component::args("effort"),
      component::in_own_thread};
  component::Operation<bool()> sensor_read_{
      this, "sensorRead", component::serve<&JointHardware::read_sensor>,
      "reads the sensors and writes what they measured", component::in_own_thread};
  component::Operation<bool()> position_known_{
      this, "positionKnown", component::serve<&JointHardware::position_known>,
      "nothing that moved was lost, or the operator has confirmed where the joint is",
      component::in_own_thread};
  component::Operation<bool()> doubt_position_{
      this,
      "doubtPosition",
      component::serve<&JointHardware::doubt_position>,
      "the joint is not armed before the operator has confirmed where it is",
      component::in_own_thread,
      component::in_any_state};
  component::Operation<bool()> is_as_told_{
      this, "isAsTold", component::serve<&JointHardware::as_told>,
      "actuator and brake have done what they were told last", component::in_own_thread};
  component::Operation<bool()> is_position_exact_{this,
                                                  "positionExact",
                                                  component::serve<&JointHardware::position_exact>,
                                                  "nothing that moved was lost",
                                                  component::in_own_thread,
                                                  component::in_any_state};
  component::Operation<bool(control::DrivePermit, double)> begin_homing_{
      this,
      "beginHoming",
      component::serve<&JointHardware::begin_homing>,
      "the joint looks for its position, with this effort of the motor at most",
      component::args("permit", "most_effort"),
      component::in_own_thread};
  component::Operation<bool(control::DrivePermit)> find_position_{
      this,
      "positionFound",
      component::serve<&JointHardware::find_position>,
      "the joint has found its position, and lost no sample meanwhile",
      component::args("permit"),
      component::in_own_thread};
  component::Operation<double()> since_index_{
      this, "sinceIndex", component::serve<&JointHardware::index_passed>,
      "by how much the motor's axis turned since its index mark; nan: it passed none",
      component::in_own_thread};
  bool is_exact_ = true;        ///< not the attribute, which tools may set
  bool is_doubted_ = false;     ///< until the operator has looked
  bool searches_ = false;       ///< its joint does, for its position
  bool homes_exactly_ = false;  ///< no sample was lost since it looks for its position
  bool is_bounded_ = false;     ///< its drive's effort
  component::Attribute<bool> position_exact_{
      this, "position_exact", true,
      "nothing that moved was lost, and it does not begin with a position that nobody confirmed"};
  component::OperatorsWord position_confirmed_{
      this, "position_confirmed",
      "the operator has looked: the joint is where its Position says; counts for a sample that was "
      "lost before, and for a position that was kept"};
  component::Operation<bool()> brake_apply_{this,
                                            "brakeApply",
                                            component::serve<&JointHardware::brake_apply>,
                                            "applies the brake",
                                            component::in_own_thread,
                                            component::in_any_state};
  component::Operation<bool(control::DrivePermit)> brake_release_{
      this,
      "brakeRelease",
      component::serve<&JointHardware::open_brake>,
      "releases the brake",
      component::args("permit"),
      component::in_own_thread};

  component::Attribute<bool> switched_on_{
      this, "switched_on", false, "its actuator was told to be on, and has not taken to be off"};
  control::DrivePermit permit_;
  int refused_ = 0;  ///< commands in a row, while it is on
  Ending ending_{*this};
};

}  // namespace armature::controllers
