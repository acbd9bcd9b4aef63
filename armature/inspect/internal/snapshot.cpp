// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/internal/snapshot.hpp"

#include "armature/component/interface.hpp"

namespace armature::inspect::internal {
namespace {

Member member(const component::Component& owner, const component::PropertyBase& property) {
  return {.component = &owner, .property = &property};
}

Member member(const component::Component& owner, const component::InputPortBase& input) {
  return {.component = &owner, .input = &input};
}

Member member(const component::Component& owner, const component::OutputPortBase& output) {
  return {.component = &owner, .output = &output};
}

void take_requirement(const component::Requirement& from, std::uint64_t not_taken,
                      Snapshot::Requirement& to) {
  to = {from.wanted(), from.peer_name(), not_taken};
}

}  // namespace

Snapshot::Snapshot(const component::Component& component)
    : raised(component::interface_of(component).events.size()),
      callers(component::interface_of(component).callers.size()),
      handlers(component::interface_of(component).handlers.size()),
      machines(component::interface_of(component).machines.size()),
      component_(component) {
  const auto make_room = [&](const auto& members, std::vector<Reading>& readings) {
    for (const auto* one : members) readings.push_back(room_for(member(component, *one)));
  };
  make_room(component::interface_of(component).properties, properties);
  make_room(component::interface_of(component).inputs, inputs);
  make_room(component::interface_of(component).outputs, outputs);
  input_counters.resize(inputs.size());
  output_counters.resize(outputs.size());
}

void Snapshot::take(base::Time now) {
  const component::Interface& all = component::interface_of(component_);
  const auto read = [&](const auto& members, std::vector<Reading>& readings) {
    for (std::size_t i = 0; i < readings.size(); ++i) {
      take_reading(member(component_, *members[i]), now, readings[i]);
    }
  };
  read(all.properties, properties);
  read(all.inputs, inputs);
  read(all.outputs, outputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) input_counters[i] = all.inputs[i]->counters();
  for (std::size_t i = 0; i < outputs.size(); ++i) output_counters[i] = all.outputs[i]->counters();
  for (std::size_t i = 0; i < raised.size(); ++i) raised[i] = all.events[i]->raised();
  for (std::size_t i = 0; i < callers.size(); ++i) {
    take_requirement(*all.callers[i], all.callers[i]->refused(), callers[i]);
  }
  for (std::size_t i = 0; i < handlers.size(); ++i) {
    take_requirement(*all.handlers[i], all.handlers[i]->dropped(), handlers[i]);
  }
  for (std::size_t i = 0; i < machines.size(); ++i) machines[i] = all.machines[i]->path();
}

}  // namespace armature::inspect::internal
