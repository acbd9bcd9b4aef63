// SPDX-License-Identifier: Apache-2.0
// A program of the usual size against the public headers: the sampled control cycle of a robot with
// two joints, seven component models and their wiring. How long it compiles is measured beside it;
// that it works is its exit status.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/rt/inbox.hpp"

namespace {

using namespace armature::component;
using namespace std::chrono_literals;

struct Limits {
  double low = -12.0;
  double high = 12.0;
};
ARMATURE_STRUCT(Limits, (low, "V"), (high, "V"));

/// Starts each cycle.
class Sampler final : public Component {
 public:
  using Component::Component;
  Event<> sample{this, "Sample", "a new cycle begins"};
  OutputPort<int> sample_port{this, "SamplePort", "number of the cycle"};
  Operation<void()> trigger{this, "trigger", serve<&Sampler::begin_cycle>, "for aperiodic use",
                            in_own_thread};

 private:
  void on_update() override { begin_cycle(); }
  void begin_cycle() {
    sample_port.write(++cycles_);
    static_cast<void>(sample.raise());
  }
  int cycles_ = 0;
};

/// A motor with an encoder, simulated: the voltage is its acceleration.
class Card final : public Component {
 public:
  using Component::Component;
  Property<double> period{this, "period", 0.001, "of a cycle", "s", range(1e-6, 1.0)};
  Property<double> damping{this, "damping", 2.0, "of the motion", "1/s"};
  Operation<double()> sensor_read{this, "sensorRead", serve<&Card::read>, "reads the encoder"};
  Operation<void(double)> actuator_set{this, "actuatorSet", serve<&Card::set>, "drives the motor",
                                       args("voltage [V]")};
  Operation<void()> actuator_on{this, "actuatorOn", serve<&Card::switch_on>, "gives power",
                                in_own_thread};
  Operation<void()> actuator_off{this, "actuatorOff", serve<&Card::switch_off>, "takes power",
                                 in_own_thread};
  Attribute<bool> powered{this, "powered", false, "whether the motor has power"};

 private:
  double read() const { return position_; }
  void set(double voltage) {
    const double power = powered() ? voltage : 0.0;
    velocity_ += (power - damping * velocity_) * period;
    position_ += velocity_ * period;
  }
  void switch_on() { powered.assign(true); }
  void switch_off() { powered.assign(false); }
  double position_ = 0.0;
  double velocity_ = 0.0;
};

/// Reads and drives the card of one joint; signs and ratios live here.
class Joint final : public Component {
 public:
  using Component::Component;
  Property<std::string> peer{this, "PeerName", "", "the joint's card", "", mandatory};
  Property<bool> brake{this, "Brake", false, "whether it has one"};
  Property<double> gear_ratio{this, "GearRatio", 1.0, "motor to joint", "", range(0.01, 1000.0)};
  Property<int> sensor_sign{this, "SensorSign", 1, "direction of the encoder", "", range(-1, 1)};
  Property<int> actuator_sign{this, "ActuatorSign", 1, "direction of the motor", "", range(-1, 1)};
  InputPort<double> voltage{this, "Voltage", "to be given at Act", "V"};
  OutputPort<double> position{this, "Position", "of the joint", "rad"};
  OutputPort<double> displacement{this, "Displacement", "in this cycle", "rad"};
  OperationCaller<double()> sensor_read{this, "sensorRead", "of the card", from(peer)};
  OperationCaller<void(double)> actuator_set{this, "actuatorSet", "of the card", from(peer)};
  OperationCaller<void()> brake_release{this, "brakeRelease", "of the card", from(peer),
                                        only_if(brake)};
  EventHandler<> on_sample{this, "Sample", serve<&Joint::sample>, "reads the sensor"};
  EventHandler<> on_act{this, "Act", serve<&Joint::act>, "drives the motor"};

 private:
  Outcome on_configure() override {
    if (peer().empty()) return refused("PeerName names no card");
    return accepted();
  }
  void sample() {
    const CallResult<double> read = sensor_read();
    if (!read) {
      error("the card does not answer");
      return;
    }
    const double now = sensor_sign * read.value / gear_ratio;
    displacement.write(now - last_);
    position.write(now);
    last_ = now;
  }
  void act() {
    const Reading<double> wanted = voltage.read();
    const double value = wanted ? actuator_sign * wanted.value : 0.0;
    static_cast<void>(actuator_set(value));
  }
  double last_ = 0.0;
};

/// Collects what all joints measured, and passes it on once all of it is there.
class SensorNMux final : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 2, "number of joints", "", range(1, 1000)};
  InputPorts<double> positions{
      this, "Position", joints, "of each joint", "rad", on_data<&SensorNMux::take_position>};
  InputPorts<double> displacements{this,   "Displacement",
                                   joints, "of each joint",
                                   "rad",  on_data<&SensorNMux::take_displacement>};
  OutputPort<std::vector<double>> sensor{this, "sensor", "positions, then displacements", "rad",
                                         size_of(joints, 2)};
  Attribute<int> incomplete{this, "incomplete", 0, "cycles in which something was missing"};
  EventHandler<> on_sample{this, "Sample", serve<&SensorNMux::begin>, "begins to collect"};

 private:
  Outcome on_start() override {
    values_.assign(2 * count(), 0.0);
    arrived_ = 0;
    return accepted();
  }
  void begin() {
    if (arrived_ != 0) incomplete.assign(incomplete + 1);
    arrived_ = 0;
  }
  std::size_t count() const { return static_cast<std::size_t>(joints.get()); }
  void take_position(std::size_t index, double value) { take(index, value); }
  void take_displacement(std::size_t index, double value) { take(count() + index, value); }
  void take(std::size_t place, double value) {
    values_[place] = value;
    if (++arrived_ < values_.size()) return;
    arrived_ = 0;
    sensor.write(values_);
  }
  std::vector<double> values_;
  std::size_t arrived_ = 0;
};

/// One-joint PID with output saturation, velocity form.
class Pid final : public Component {
 public:
  using Component::Component;
  Property<double> kp{this, "Kp", 40.0, "proportional gain", "V/rad", changeable_while_running};
  Property<double> ki{this, "Ki", 0.01, "integral gain", "V/rad", changeable_while_running};
  Property<double> kd{this, "Kd", 900.0, "differential gain", "V/rad", changeable_while_running};
  Property<Limits> limits{this, "limits", {}, "of the control signal", "V"};
  InputPort<double> reference{this, "Ref", "desired position", "rad"};
  InputPort<double> measured{this, "Sen", "measured position", "rad", on_data<&Pid::step>};
  OutputPort<double> output{this, "Out", "control signal", "V"};
  Operation<void()> reset{this, "reset", serve<&Pid::forget>, "forgets past errors"};

 private:
  Outcome on_start() override {
    forget();
    return accepted();
  }
  void forget() { fresh_ = true; }
  void step(double position) {
    const double e = reference.read().value - position;
    if (fresh_) e1_ = e2_ = e;
    if (fresh_) u_ = 0.0;
    fresh_ = false;
    u_ += kp * (e - e1_) + ki * e + kd * (e - 2.0 * e1_ + e2_);
    u_ = std::clamp(u_, limits().low, limits().high);
    e2_ = e1_;
    e1_ = e;
    output.write(u_);
  }
  bool fresh_ = true;
  double e1_ = 0.0;
  double e2_ = 0.0;
  double u_ = 0.0;
};

/// Spreads the measured vector over N controllers, and joins their outputs.
class ControllerNPid final : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 2, "number of joints", "", range(1, 1000)};
  InputPort<std::vector<double>> reference{this,  "reference",     "desired positions",
                                           "rad", size_of(joints), max_age(500ms, Reaction::kHold)};
  InputPort<std::vector<double>> sensor{
      this,  "sensor",           "what was measured",
      "rad", size_of(joints, 2), on_data<&ControllerNPid::control>};
  OutputPorts<double> references{this, "Ref", joints, "for each PID", "rad"};
  OutputPorts<double> measured{this, "Sen", joints, "for each PID", "rad"};
  InputPorts<double> outputs{this,          "Out", joints,
                             "of each PID", "V",   on_data<&ControllerNPid::collect>};
  OutputPort<std::vector<double>> act{this, "act", "control signals", "V", size_of(joints)};

 private:
  Outcome on_start() override {
    signals_.assign(static_cast<std::size_t>(joints.get()), 0.0);
    arrived_ = 0;
    return accepted();
  }
  void control(const std::vector<double>& now) {
    const Reading<std::vector<double>> wanted = reference.read();
    for (std::size_t i = 0; i < references.size(); ++i) {
      references[i].write(wanted ? wanted.value[i] : now[i]);
      measured[i].write(now[i]);
    }
  }
  void collect(std::size_t index, double signal) {
    signals_[index] = signal;
    if (++arrived_ < signals_.size()) return;
    arrived_ = 0;
    act.write(signals_);
  }
  std::vector<double> signals_;
  std::size_t arrived_ = 0;
};

/// Gives each joint its control signal, and the order to act.
class ActuatorNDemux final : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 2, "number of joints", "", range(1, 1000)};
  InputPort<std::vector<double>> act{this, "act",           "control signals",
                                     "V",  size_of(joints), on_data<&ActuatorNDemux::actuate>};
  OutputPorts<double> voltages{this, "Voltage", joints, "for each joint", "V"};
  Event<> act_event{this, "Act", "all joints have their voltage"};

 private:
  void actuate(const std::vector<double>& signals) {
    for (std::size_t i = 0; i < voltages.size(); ++i) voltages[i].write(signals[i]);
    static_cast<void>(act_event.raise());
  }
};

/// Moves all axes together along a straight line, after it was armed.
class AxesGenerator final : public Component {
 public:
  using Component::Component;
  Property<int> axes{this, "num_axes", 2, "number of axes", "", range(1, 1000)};
  Property<double> speed{this, "max_vel", 1.0, "of the fastest axis", "rad/s", range(0.0, 10.0)};
  OutputPort<std::vector<double>> desired{this, "nAxesDesiredPosition", "to follow", "rad",
                                          size_of(axes)};
  OperationTrigger arm{this, "arm", "an act of the operator"};
  OperationTrigger disarm{this, "disarm", "nothing moves any more"};
  Command<const std::vector<double>&> move_to{this,
                                              "moveTo",
                                              serve<&AxesGenerator::begin>,
                                              "moves all axes",
                                              args("positions [rad]"),
                                              done_when<&AxesGenerator::arrived>,
                                              cancelled_by<&AxesGenerator::hold>};
  StateMachine mode{this, "mode", "what the generator is doing",
                    in_state("Disarmed", "nothing moves", on(arm, to("Armed"))),
                    in_state("Armed", leaving<&AxesGenerator::hold>, on(disarm, to("Disarmed")),
                             in_state("Resting", when<&AxesGenerator::under_way>(to("Moving"))),
                             in_state("Moving", during<&AxesGenerator::go_on>,
                                      when<&AxesGenerator::arrived>(to("Resting")),
                                      after(60s, doing<&AxesGenerator::hold>, to("Resting"))))};

 private:
  Outcome on_start() override {
    position_.assign(static_cast<std::size_t>(axes.get()), 0.0);
    target_ = position_;
    return accepted();
  }
  Outcome begin(const std::vector<double>& target) {
    if (!mode.is_in("Armed")) return refused("not armed");
    if (target.size() != target_.size()) return refused("wrong number of positions");
    for (const double each : target) {
      if (!std::isfinite(each)) return refused("not a finite position");
    }
    target_ = target;
    return accepted();
  }
  void on_update() override { desired.write(position_); }
  bool arrived() const { return position_ == target_; }
  bool under_way() const { return !arrived(); }
  void hold() { target_ = position_; }
  void go_on() {
    const double step = speed * 0.001;
    for (std::size_t i = 0; i < position_.size(); ++i) {
      position_[i] += std::clamp(target_[i] - position_[i], -step, step);
    }
  }
  std::vector<double> position_;
  std::vector<double> target_;
};

class Operator final : public Component {
 public:
  using Component::Component;
  OperationCaller<bool()> arm{this, "arm", "of the generator"};
  CommandCaller<const std::vector<double>&> move_to{this, "moveTo", "of the generator"};
};

OperationBase& operation(const Component& component, std::string_view name) {
  const auto& all = interface_of(component).operations;
  return **std::find_if(all.begin(), all.end(), [&](auto* each) { return each->name() == name; });
}

void run_cycle(ExecutionContext& context, Sampler& sampler, AxesGenerator& generator) {
  context.cycle_time = context.cycle_time.load() + 1ms;
  ++context.cycle;
  context.inbox.deliver_all();
  Host::update(generator);
  Host::update(sampler);
}

}  // namespace

int main() {
  ExecutionContext context("main");
  Sampler sampler("sampler");
  SensorNMux mux("mux");
  ControllerNPid controller("controller");
  ActuatorNDemux demux("demux");
  AxesGenerator generator("generator");
  Operator human("operator");
  std::vector<Component*> all{&sampler, &mux, &controller, &demux, &generator, &human};
  std::vector<std::unique_ptr<Component>> owned;
  for (OutputPortBase* out : {static_cast<OutputPortBase*>(&face(mux.sensor)),
                              static_cast<OutputPortBase*>(&face(controller.act)),
                              static_cast<OutputPortBase*>(&face(generator.desired))}) {
    out->prepare();
  }
  face(mux.sensor).connect(face(controller.sensor), {});
  face(generator.desired).connect(face(controller.reference), {});
  face(controller.act).connect(face(demux.act), {});
  face(sampler.sample).subscribe(face(mux.on_sample));
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string number = std::to_string(i + 1);
    auto card = std::make_unique<Card>("card" + number);
    auto joint = std::make_unique<Joint>("joint" + number);
    auto pid = std::make_unique<Pid>("pid" + number);
    if (!joint->peer.set(armature::types::Value::of(card->name()))) return 1;
    face(joint->sensor_read).connect(face(card->sensor_read));
    face(joint->actuator_set).connect(face(card->actuator_set));
    card->powered.assign(true);
    face(sampler.sample).subscribe(face(joint->on_sample));
    face(demux.act_event).subscribe(face(joint->on_act));
    face(joint->displacement).connect(face(mux.displacements[i]), {});
    face(joint->position).connect(face(mux.positions[i]), {});
    face(controller.references[i]).connect(face(pid->reference), {});
    face(controller.measured[i]).connect(face(pid->measured), {});
    face(pid->output).connect(face(controller.outputs[i]), {});
    face(demux.voltages[i]).connect(face(joint->voltage), {});
    for (Component* each :
         {static_cast<Component*>(card.get()), static_cast<Component*>(joint.get()),
          static_cast<Component*>(pid.get())}) {
      all.push_back(each);
    }
    owned.push_back(std::move(card));
    owned.push_back(std::move(joint));
    owned.push_back(std::move(pid));
  }
  face(human.arm).connect(operation(generator, "arm"));
  face(human.move_to).connect(face(generator.move_to));
  for (Component* each : all) {
    Host::assign_context(*each, context);
    if (!Host::configure(*each) || !Host::start(*each)) return 2;
  }
  if (!human.arm().value) return 3;
  const CommandHandle move = human.move_to.send({0.5, -0.25});
  for (int i = 0; i < 5000; ++i) run_cycle(context, sampler, generator);
  const double reached = static_cast<Joint&>(*owned[1]).position.last();
  std::printf("joint 1 is at %.4f rad, the command is %s, the generator %s\n", reached,
              std::string(name_of(move.stage())).c_str(),
              std::string(generator.mode.path()).c_str());
  const bool arrived = move.stage() == CommandStage::kDone && std::abs(reached - 0.5) < 0.01;
  return arrived && mux.incomplete == 0 ? 0 : 4;
}
