// SPDX-License-Identifier: Apache-2.0
#include "armature/base/seconds.hpp"
#include "armature/component/component.hpp"
#include "armature/component/ports/port.hpp"
#include "armature/remote/internal/inspection.hpp"

namespace armature::remote::internal {
namespace {

ThreadStatus wire_of(const inspect::ThreadStatus& from) {
  return {from.name,
          from.activity,
          static_cast<std::int32_t>(from.components),
          from.cycles,
          from.skipped,
          from.log_lines_dropped,
          from.cycle_median_us,
          from.cycle_high_us,
          from.cycle_most_us,
          from.load_percent,
          from.latency_median_us,
          from.latency_most_us};
}

PropertyDetails wire_of(const inspect::PropertyDescription& from) {
  PropertyDetails to;
  to.name = from.name;
  to.doc = inspect::doc_with_values(from.doc, from.values);
  to.type = from.type;
  to.unit = from.unit;
  to.value = from.value;
  to.limited = from.range.has_value();
  if (from.range) {
    to.low = from.range->low;
    to.high = from.range->high;
  }
  to.persistent = from.persistent;
  to.changeable = from.changeable_while_running;
  to.mandatory = from.mandatory;
  to.by_operator = from.by_operator;
  return to;
}

PortDetails wire_of_port(const inspect::PortDescription& from) {
  PortDetails to;
  to.name = from.name;
  to.doc = inspect::doc_with_values(from.doc, from.values);
  to.type = from.type;
  to.unit = from.unit;
  to.value = from.value;
  to.written = from.written;
  to.age = base::to_seconds(from.age);
  to.size = from.size ? static_cast<std::int32_t>(*from.size) : -1;
  to.peers = from.peers;
  return to;
}

PortDetails wire_of_input(const inspect::InputDescription& from) {
  PortDetails to = wire_of_port(from);
  to.max_age = base::to_seconds(from.max_age);
  to.when_stale = component::name_of(from.when_stale);
  to.triggers = from.triggers;
  return to;
}

OperationDetails wire_of(const inspect::OperationDescription& from) {
  const auto argument = [](const inspect::ArgumentDescription& one) {
    return ArgumentDetails{one.name, one.type};
  };
  return {from.name,   from.doc,     from.signature,  each(from.arguments, argument),
          from.result, from.command, from.by_operator};
}

EventDetails wire_of(const inspect::EventDescription& from) {
  return {from.name, from.doc, from.signature, from.subscribers};
}

RequirementDetails wire_of(const inspect::RequirementDescription& from) {
  return {from.name,    from.doc,      from.signature, from.event,
          from.command, from.optional, from.bound_to};
}

MachineDetails wire_of(const inspect::MachineDescription& from) {
  const auto path = [](const inspect::MachineDescription::State& state) { return state.path; };
  return {from.name, from.doc, each(from.states, path), from.current};
}

FieldDetails wire_of(const inspect::FieldDescription& from) {
  return {from.structure, from.name, from.type, from.unit,
          inspect::doc_with_values(from.doc, from.values)};
}

constexpr auto kWireOf = [](const auto& one) { return wire_of(one); };

}  // namespace

ApplicationStatus to_wire(const inspect::ApplicationStatus& from) {
  return {from.name,
          base::to_seconds(from.time - base::Time{}),
          from.simulated,
          from.mode,
          from.faults,
          from.reactions,
          each(from.threads, kWireOf)};
}

ComponentStatus to_wire(const inspect::ComponentStatus& from) {
  return {from.name,
          from.model,
          from.state ? std::string(component::name_of(*from.state)) : std::string(),
          from.reason,
          from.thread,
          from.autostart,
          from.start_order};
}

Faults to_wire(const inspect::Faults& from) {
  return {from.faults, from.reactions,
          each(from.components, [](const auto& one) { return to_wire(one); })};
}

ComponentDetails to_wire(const inspect::ComponentDescription& from) {
  ComponentDetails to;
  to.status = to_wire(static_cast<const inspect::ComponentStatus&>(from));
  to.activity = from.activity;
  to.answered = from.answered;
  to.properties = each(from.properties, kWireOf);
  to.inputs = each(from.inputs, wire_of_input);
  to.outputs = each(from.outputs, wire_of_port);
  to.operations = each(from.operations, kWireOf);
  to.events = each(from.events, kWireOf);
  to.requirements = each(from.requirements, kWireOf);
  to.machines = each(from.machines, kWireOf);
  to.fields = each(from.fields, kWireOf);
  return to;
}

ConnectionDetails to_wire(const inspect::Connection& from) {
  return {from.kind, from.from, from.to, from.triggers, from.delayed, from.crosses_threads};
}

ItemValue to_wire(const inspect::ItemValue& from) {
  return {from.item,
          from.kind,
          from.type,
          from.unit,
          from.value,
          from.written,
          base::to_seconds(from.age),
          from.error};
}

CallResult to_wire(const inspect::CallResult& from) { return {from.given, from.type, from.value}; }

CommandStatus to_wire(const inspect::CommandStatus& from) {
  return {from.handle, from.name,     std::string(component::name_of(from.stage)),
          from.ended,  from.progress, from.reason};
}

Watch to_wire(const inspect::Watch& from) {
  return {from.handle, each(from.items, [](const inspect::WatchedItem& one) {
            return WatchedItem{one.item, one.unit};
          })};
}

WatchedValues to_wire(const inspect::WatchedValues& from) {
  return {from.values, from.ages, from.replaced};
}

Cycle to_wire(const inspect::Cycle& from) {
  const auto microseconds = [](base::Duration time) { return base::to_seconds(time) * 1e6; };
  return {from.number, base::to_seconds(from.time - base::Time{}), microseconds(from.length),
          each(from.steps,
               [&](const inspect::CycleStep& one) {
                 return CycleStep{one.component, microseconds(one.begin), microseconds(one.length)};
               }),
          from.left_out};
}

LogLines to_wire(const inspect::LogLines& from) {
  return {each(from.lines,
               [](const exec::LogLine& one) {
                 return LogLine{one.number, base::to_seconds(one.time - base::Time{}),
                                std::string(rt::name_of(one.level)), one.component, one.text};
               }),
          from.left_out};
}

Pace to_wire(const exec::Pace& from) { return {from.rate, from.paused}; }

}  // namespace armature::remote::internal
