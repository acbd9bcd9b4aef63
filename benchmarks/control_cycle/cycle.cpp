// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/control_cycle/cycle.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "benchmarks/control_cycle/components.hpp"
#include "benchmarks/control_cycle/pacer.hpp"

namespace armature::benchmarks {
namespace {

template <typename T>
void set(Component& component, std::string_view name, const T& value) {
  for (PropertyBase* property : component.interface().properties) {
    if (property->name() == name) static_cast<void>(property->set(types::Value::of(value)));
  }
}

template <typename Model>
Model& add(exec::Blueprint& blueprint, const std::string& name,
           std::initializer_list<std::string> peers = {}, const exec::Activity& activity = {}) {
  Model& component = blueprint.add<Model>(name, activity);
  for (const std::string& peer : peers) blueprint.components.back().peers.push_back({peer, {}});
  return component;
}

void add_joints(exec::Blueprint& blueprint, int joints) {
  for (int i = 1; i <= joints; ++i) add<Card>(blueprint, "Card" + std::to_string(i));
  for (int i = 1; i <= joints; ++i) {
    const std::string card = "Card" + std::to_string(i);
    Component& made =
        add<Joint>(blueprint, "Joint" + std::to_string(i), {card, "Sampler", "Actuator"});
    set(made, "PeerName", card);
    set(made, "GearRatio", gear_ratio_of(i - 1));
  }
  for (int i = 1; i <= joints; ++i) add<Pid>(blueprint, "PID" + std::to_string(i));
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
  blueprint.connect("Controller.Ref" + number, pid + ".Ref");
  blueprint.connect("Controller.Sen" + number, pid + ".Sen");
  blueprint.connect(pid + ".Out", "Controller.Out" + number);
  blueprint.connect("Actuator.Voltage" + number, joint + ".Voltage");
}

}  // namespace

CycleThreads one_thread() {
  CycleThreads threads;
  threads.sampler = exec::Activity::periodic(std::chrono::milliseconds(1));
  return threads;
}

exec::Blueprint make_cycle(int joints, const CycleThreads& threads) {
  exec::Blueprint blueprint;
  blueprint.name = "control cycle";
  add<Sampler>(blueprint, "Sampler", {}, threads.sampler);
  set(add<SensorNMux>(blueprint, "Sensor", {"Sampler"}, threads.sensor), "joints", joints);
  set(add<Reference>(blueprint, "Reference"), "joints", joints);
  set(add<ControllerNPid>(blueprint, "Controller", {}, threads.controller), "joints", joints);
  set(add<ActuatorNDemux>(blueprint, "Actuator", {"Sampler"}, threads.actuator), "joints", joints);
  blueprint.connect("Reference.reference", "Controller.reference");
  blueprint.connect("Sensor.sensor", "Controller.sensor");
  blueprint.connect("Controller.act", "Actuator.act");
  add_joints(blueprint, joints);
  for (int i = 1; i <= joints; ++i) connect_joint(blueprint, std::to_string(i));
  return blueprint;
}

Pacer& add_pacer(exec::Blueprint& blueprint, int joints) {
  Pacer& pacer = add<Pacer>(blueprint, "Pacer", {"Sampler", "Actuator"});
  set(pacer, "joints", joints);
  for (int i = 1; i <= joints; ++i) {
    const std::string number = std::to_string(i);
    blueprint.connect("Joint" + number + ".Position", "Pacer.Position" + number);
  }
  return pacer;
}

}  // namespace armature::benchmarks
