// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "armature/base/seconds.hpp"
#include "armature/remote/internal/inspection.hpp"
#include "armature/types/enum.hpp"

namespace armature::remote::internal {
namespace {

using component::CommandStage;
using component::State;

/// A century, so that no number of a peer is too large for a duration.
constexpr double kLongestSeconds = 3e9;

base::Duration duration_of(double seconds) {
  return std::abs(seconds) <= kLongestSeconds ? base::from_seconds(seconds) : base::Duration{};
}

template <typename Enum>
std::optional<Enum> named(const std::string& name, std::initializer_list<Enum> all) {
  const auto found =
      std::ranges::find_if(all, [&](Enum one) { return component::name_of(one) == name; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

std::optional<State> state_named(const std::string& name) {
  return named(name, {State::kPreOperational, State::kException, State::kStopped, State::kRunning,
                      State::kRunTimeError});
}

CommandStage stage_named(const std::string& name) {
  return named(name, {CommandStage::kQueued, CommandStage::kWaiting, CommandStage::kAccepted,
                      CommandStage::kRefused, CommandStage::kDone, CommandStage::kFailed,
                      CommandStage::kCancelled})
      .value_or(CommandStage::kFree);
}

/// An unknown one is taken for a grave one.
rt::LogLevel level_named(const std::string& name) {
  for (const auto level : {rt::LogLevel::kDebug, rt::LogLevel::kInfo, rt::LogLevel::kWarning}) {
    if (rt::name_of(level) == name) return level;
  }
  return rt::LogLevel::kError;
}

inspect::ThreadStatus told(const ThreadStatus& from) {
  return {from.name,
          from.activity,
          static_cast<std::size_t>(std::max(from.components, 0)),
          from.cycles,
          from.skipped,
          from.log_lines_dropped,
          from.cycle_median,
          from.cycle_high,
          from.cycle_most,
          from.load,
          from.latency_median,
          from.latency_most};
}

inspect::PropertyDescription told(const PropertyDetails& from) {
  inspect::PropertyDescription to;
  to.name = from.name;
  to.doc = from.doc;
  to.type = from.type;
  to.unit = from.unit;
  to.value = from.value;
  if (from.limited) to.range = component::Range{from.low, from.high};
  to.persistent = from.persistent;
  to.changeable_while_running = from.changeable;
  to.mandatory = from.mandatory;
  to.by_operator = from.by_operator;
  return to;
}

template <typename Port>
Port told_port(const PortDetails& from) {
  Port to;
  to.name = from.name;
  to.doc = from.doc;
  to.type = from.type;
  to.unit = from.unit;
  to.value = from.value;
  to.written = from.written;
  to.age = duration_of(from.age);
  if (from.size >= 0) to.size = static_cast<std::size_t>(from.size);
  to.peers = from.peers;
  return to;
}

inspect::InputDescription told_input(const PortDetails& from) {
  auto to = told_port<inspect::InputDescription>(from);
  to.max_age = duration_of(from.max_age);
  to.when_stale = types::value_named<component::Reaction>(from.when_stale).value_or(to.when_stale);
  to.triggers = from.triggers;
  return to;
}

inspect::OperationDescription told(const OperationDetails& from) {
  inspect::OperationDescription to;
  to.name = from.name;
  to.doc = from.doc;
  to.signature = from.signature;
  to.arguments = each(from.arguments, [](const ArgumentDetails& one) {
    return inspect::ArgumentDescription{one.name, one.type};
  });
  to.result = from.result;
  to.command = from.command;
  to.by_operator = from.by_operator;
  return to;
}

inspect::EventDescription told(const EventDetails& from) {
  inspect::EventDescription to;
  to.name = from.name;
  to.doc = from.doc;
  to.signature = from.signature;
  to.subscribers = from.subscribers;
  return to;
}

inspect::RequirementDescription told(const RequirementDetails& from) {
  inspect::RequirementDescription to;
  to.name = from.name;
  to.doc = from.doc;
  to.signature = from.signature;
  to.event = from.event;
  to.command = from.command;
  to.optional = from.optional;
  to.bound_to = from.bound_to;
  return to;
}

inspect::MachineDescription told(const MachineDetails& from) {
  inspect::MachineDescription to;
  to.name = from.name;
  to.doc = from.doc;
  to.states = each(from.states, [](const std::string& path) {
    return inspect::MachineDescription::State{path, {}, false};
  });
  to.current = from.current;
  return to;
}

inspect::FieldDescription told(const FieldDetails& from) {
  return {from.structure, from.name, from.type, from.unit, from.doc, {}};
}

constexpr auto kTold = [](const auto& one) { return told(one); };

}  // namespace

inspect::ApplicationStatus from_wire(const ApplicationStatus& from) {
  return {from.name,
          base::Time{} + duration_of(from.time),
          from.simulated,
          from.mode,
          from.faults,
          from.reactions,
          each(from.threads, kTold)};
}

inspect::ComponentStatus from_wire(const ComponentStatus& from) {
  return {from.model,  from.name,      state_named(from.state), from.reason,
          from.thread, from.autostart, from.start_order};
}

inspect::Faults from_wire(const Faults& from) {
  return {from.faults, from.reactions,
          each(from.components, [](const auto& one) { return from_wire(one); })};
}

inspect::ComponentDescription from_wire(const ComponentDetails& from) {
  inspect::ComponentDescription to;
  static_cast<inspect::ComponentStatus&>(to) = from_wire(from.status);
  to.activity = from.activity;
  to.answered = from.answered;
  to.properties = each(from.properties, kTold);
  to.inputs = each(from.inputs, told_input);
  to.outputs = each(from.outputs, told_port<inspect::OutputDescription>);
  to.operations = each(from.operations, kTold);
  to.events = each(from.events, kTold);
  to.requirements = each(from.requirements, kTold);
  to.machines = each(from.machines, kTold);
  to.fields = each(from.fields, kTold);
  return to;
}

inspect::Connection from_wire(const ConnectionDetails& from) {
  return {from.kind, from.from, from.to, from.triggers, from.delayed, from.crosses_threads};
}

inspect::ItemValue from_wire(const ItemValue& from) {
  return {
      from.item, from.kind, from.type, from.unit, from.value, from.written, duration_of(from.age),
      from.error};
}

inspect::CallResult from_wire(const CallResult& from) {
  return {from.given, from.type, from.value};
}

inspect::CommandStatus from_wire(const CommandStatus& from) {
  return {from.handle, from.command,  stage_named(from.stage),
          from.ended,  from.progress, from.reason};
}

inspect::Watch from_wire(const Watch& from) {
  return {from.handle, each(from.items, [](const WatchedItem& one) {
            return inspect::WatchedItem{one.item, one.unit};
          })};
}

inspect::WatchedValues from_wire(const WatchedValues& from) {
  return {from.values, from.ages, from.replaced};
}

inspect::Cycle from_wire(const Cycle& from) {
  const auto from_microseconds = [](double time) { return duration_of(time * 1e-6); };
  return {from.number, base::Time{} + duration_of(from.time), from_microseconds(from.length),
          each(from.steps,
               [&](const CycleStep& one) {
                 return inspect::CycleStep{one.component, from_microseconds(one.begin),
                                           from_microseconds(one.length)};
               }),
          from.left_out};
}

inspect::LogLines from_wire(const LogLines& from) {
  return {each(from.lines,
               [](const LogLine& one) {
                 return exec::LogLine{one.number, base::Time{} + duration_of(one.time),
                                      level_named(one.level), one.component, one.text};
               }),
          from.left_out};
}

exec::Pace from_wire(const Pace& from) { return {from.rate, from.paused}; }

}  // namespace armature::remote::internal
