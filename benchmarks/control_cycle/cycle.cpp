// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/control_cycle/cycle.hpp"

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/controllers/actuator_demux/actuator_demux.hpp"
#include "armature/controllers/arming/arming.hpp"
#include "armature/controllers/controller_npid/controller_npid.hpp"
#include "armature/controllers/joint/joint.hpp"
#include "armature/controllers/pid/pid.hpp"
#include "armature/controllers/sampler/sampler.hpp"
#include "armature/controllers/sensor_mux/sensor_mux.hpp"
#include "benchmarks/control_cycle/pacer.hpp"
#include "benchmarks/control_cycle/stand_ins.hpp"
#include "benchmarks/set_property.hpp"

namespace armature::benchmarks {
namespace {

using component::Component;

constexpr double kUnwatched = 1e3;

template <typename Model>
Model& add(exec::Blueprint& blueprint, const std::string& name,
           std::initializer_list<std::string> peers = {}, const exec::Activity& activity = {}) {
  Model& component = blueprint.add<Model>(name, activity);
  for (const std::string& peer : peers) blueprint.components.back().peers.push_back({peer, {}});
  return component;
}

void add_joint(exec::Blueprint& blueprint, const std::string& number, double gear_ratio,
               base::Duration period) {
  const std::string card = "Card" + number;
  Component& joint =
      add<controllers::Joint>(blueprint, "Joint" + number, {card, "Sampler", "Actuator", "Arming"});
  const control::JointLimiter::Config limits = limits_of_joints();
  set(joint, "PeerName", card);
  set(joint, "GearRatio", gear_ratio);
  set(joint, "PositionMin", limits.lower);
  set(joint, "PositionMax", limits.upper);
  set(joint, "MaxVelocity", limits.max_velocity);
  set(joint, "MaxAcceleration", limits.max_acceleration);
  set(joint, "MaxVoltage", limits.max_effort);
  set(joint, "Period", base::to_seconds(period));
  set(joint, "ArmingTime", base::to_seconds(limits.arming_time));
  // They are sent to their place by a step, and nothing is watched in the loop beside them.
  set(joint, "HoldingMotion", kUnwatched);
  set(joint, "HoldingVelocity", kUnwatched);
  set(joint, "HoldingAlternation", 1.0);
}

void add_pid(exec::Blueprint& blueprint, const std::string& number) {
  Component& pid = add<controllers::Pid>(blueprint, "PID" + number, {"Arming"});
  set(pid, "Kp", kKp);
  set(pid, "Ki", kKi);
  set(pid, "Kd", kKd);
  set(pid, "UMin", -kMaxVoltage);
  set(pid, "UMax", kMaxVoltage);
}

void add_joints(exec::Blueprint& blueprint, int joints, base::Duration period) {
  for (int i = 1; i <= joints; ++i) add<Card>(blueprint, "Card" + std::to_string(i));
  for (int i = 1; i <= joints; ++i) {
    add_joint(blueprint, std::to_string(i), gear_ratio_of(i - 1), period);
  }
  for (int i = 1; i <= joints; ++i) add_pid(blueprint, std::to_string(i));
}

void connect_joint(exec::Blueprint& blueprint, const std::string& number) {
  const std::string card = "Card" + number;
  const std::string joint = "Joint" + number;
  const std::string pid = "PID" + number;
  blueprint.connect(card + ".DisplacementSensor", joint + ".DisplacementSensor");
  blueprint.connect(card + ".IndexSensor", joint + ".IndexSensor");
  blueprint.connect(joint + ".VoltageActuator", card + ".VoltageActuator");
  blueprint.connect(joint + ".Position", "Sensor.Position" + number);
  blueprint.connect(joint + ".Displacement", "Sensor.Displacement" + number);
  blueprint.connect(joint + ".Armed", "Arming.Armed" + number);
  blueprint.connect("Controller.Ref" + number, pid + ".Ref");
  blueprint.connect("Controller.Sen" + number, pid + ".Sen");
  blueprint.connect(pid + ".Out", "Controller.Out" + number);
  blueprint.connect("Actuator.Voltage" + number, joint + ".Voltage");
}

/// Between two batches of cycles everything stands still, for as long as that takes: nothing is to
/// be too old then. What looks at the ages is there as ever.
void let_data_wait(exec::Blueprint& blueprint) {
  for (exec::ConnectionEntry& connection : blueprint.connections) {
    const std::string& port = connection.to_port;
    const bool ages = port == "sensor" || port == "reference" || port == "act" ||
                      port.starts_with("Ref") || port.starts_with("Sen") ||
                      port.starts_with("Voltage");
    if (ages) connection.max_age = component::max_age(std::chrono::hours(1));
  }
}

void connect_vectors(exec::Blueprint& blueprint) {
  blueprint.connect("Sensor.sensor", "Controller.sensor");
  blueprint.connect("Sensor.sensor", "Reference.sensor");
  blueprint.connect("Reference.reference", "Controller.reference");
  blueprint.connect("Reference.nAxesSensorPosition", "Arming.nAxesSensorPosition");
  blueprint.connect("Reference.nAxesDesiredPosition", "Arming.nAxesDesiredPosition");
  blueprint.connect("Reference.nAxesDesiredVelocity", "Arming.nAxesDesiredVelocity");
  blueprint.connect("Controller.act", "Actuator.act");
}

}  // namespace

CycleThreads one_thread() {
  CycleThreads threads;
  threads.sampler = exec::Activity::periodic(threads.period);
  return threads;
}

exec::Blueprint make_cycle(int joints, const CycleThreads& threads) {
  const exec::Activity slowly = exec::Activity::periodic(std::chrono::milliseconds(10));
  exec::Blueprint blueprint;
  blueprint.name = "control cycle";
  add<controllers::Sampler>(blueprint, "Sampler", {}, threads.sampler);
  set(add<controllers::SensorNMux>(blueprint, "Sensor", {"Sampler"}, threads.sensor), "joints",
      joints);
  set(add<Reference>(blueprint, "Reference", {"Arming"}, slowly), "joints", joints);
  set(add<controllers::Arming>(blueprint, "Arming", {}, slowly), "joints", joints);
  set(add<controllers::ControllerNPID>(blueprint, "Controller", {"Sampler"}, threads.controller),
      "joints", joints);
  set(add<controllers::ActuatorNDemux>(blueprint, "Actuator", {"Sampler"}, threads.actuator),
      "joints", joints);
  connect_vectors(blueprint);
  add_joints(blueprint, joints, threads.period);
  for (int i = 1; i <= joints; ++i) connect_joint(blueprint, std::to_string(i));
  return blueprint;
}

Pacer& add_pacer(exec::Blueprint& blueprint, int joints) {
  let_data_wait(blueprint);
  Pacer& pacer = add<Pacer>(blueprint, "Pacer", {"Sampler", "Actuator"});
  set(pacer, "joints", joints);
  for (int i = 1; i <= joints; ++i) {
    const std::string number = std::to_string(i);
    blueprint.connect("Joint" + number + ".Position", "Pacer.Position" + number);
  }
  return pacer;
}

void arm(exec::Application& application, const std::function<void()>& cycle) {
  auto arming = application.begin("Arming", "arm", {});
  if (!arming) throw std::runtime_error(arming.error());
  const base::Time latest = base::later(application.now(), std::chrono::seconds(10));
  const auto run_until = [&](const std::function<bool()>& done) {
    while (!done() && application.now() < latest) {
      if (cycle) cycle();
      application.run_for(std::chrono::milliseconds(1));
    }
  };
  run_until([&] { return arming.value().ended(); });
  if (arming.value().stage() != component::CommandStage::kDone) {
    throw std::runtime_error("not armed: " + std::string(arming.value().reason()));
  }
  const auto& card = static_cast<const Card&>(*application.find("Card1"));
  run_until([&] { return card.driven() > 0; });
  if (card.driven() == 0) throw std::runtime_error("armed, but sent nowhere");
}

}  // namespace armature::benchmarks
