// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/inspection.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/author.hpp"
#include "armature/exec/modes.hpp"
#include "armature/inspect/items.hpp"
#include "armature/platform/clock.hpp"
#include "armature/types/elements.hpp"
#include "inspection_types.hpp"

namespace armature::remote {

using namespace inspect;
namespace {

using component::Component;

std::string activity_text(const exec::Activity& activity) {
  if (activity.kind != exec::Activity::Kind::kPeriodic) {
    return std::string(exec::name_of(activity.kind));
  }
  char text[40];
  std::snprintf(text, sizeof text, "every %g ms", 1000.0 * base::to_seconds(activity.period));
  return text;
}

double microseconds(double ns) { return ns / 1000.0; }

ThreadStatus status_of(const exec::ThreadStatistics& thread, const exec::ThreadPlan& plan) {
  ThreadStatus status;
  status.name = plan.name;
  status.activity = activity_text(plan.activity);
  status.components = static_cast<std::int32_t>(plan.members.size());
  status.cycles = thread.cycles_run;
  status.skipped = thread.cycles_skipped;
  status.log_lines_dropped = thread.log_lines_dropped;
  if (thread.cycles_run == 0) return status;
  const double tick_us = microseconds(platform::tick_period_ns());
  status.cycle_median = static_cast<double>(thread.cycle_ticks.percentile(0.5)) * tick_us;
  status.cycle_high = static_cast<double>(thread.cycle_ticks.percentile(0.999)) * tick_us;
  status.cycle_most = static_cast<double>(thread.cycle_ticks.most) * tick_us;
  const auto period = static_cast<double>(plan.activity.period.count());
  if (period > 0.0) {
    status.load = 100.0 * thread.cycle_ticks.mean() * tick_us / microseconds(period);
  }
  status.latency_median = microseconds(static_cast<double>(thread.latency_ns.percentile(0.5)));
  status.latency_most = microseconds(static_cast<double>(thread.latency_ns.most));
  return status;
}

/// The structs that a type has in it, each once.
void add_fields(const types::Type& type, std::vector<FieldDetails>& fields) {
  if (types::is_list(type)) return add_fields(*type.element, fields);
  if (type.kind != types::Kind::kStruct) return;
  const bool known = std::any_of(fields.begin(), fields.end(), [&](const FieldDetails& field) {
    return field.structure == type.name;
  });
  if (known) return;
  for (const types::Field& field : type.fields) {
    fields.push_back({std::string(type.name), std::string(field.name), field.type->name,
                      std::string(field.unit),
                      types::doc_with_enumerators(field.doc, *field.type)});
  }
  for (const types::Field& field : type.fields) add_fields(*field.type, fields);
}

ComponentStatus status_without_reason(const exec::Application& application,
                                      const Component& component) {
  const exec::ComponentEntry& entry = entry_of(application, component);
  const auto index = static_cast<exec::Index>(&entry - application.blueprint().components.data());
  const std::vector<exec::Index>& order = application.plan().start_order;
  ComponentStatus status;
  status.name = component.name();
  status.model = entry.model;
  status.state = component::name_of(component.state());
  status.thread = thread_of(application, component).name;
  status.autostart = entry.autostart;
  status.start_order =
      static_cast<std::int32_t>(std::find(order.begin(), order.end(), index) - order.begin());
  return status;
}

bool runs(const ComponentStatus& status) {
  return status.state == component::name_of(component::State::kRunning);
}

/// Why components of one thread are as they are, which that thread knows.
std::vector<std::string> reasons_of(exec::Application& application, const Components& components) {
  const auto reasons = std::make_shared<std::vector<std::string>>();
  const bool answered = application.run_in_thread_of(*components.front(), [reasons, components] {
    for (const Component* const one : components) reasons->emplace_back(one->reason());
  });
  if (answered) return *reasons;
  return std::vector<std::string>(components.size(), "its thread does not answer");
}

/// Puts the values of a component's members into its details.
class Details {
 public:
  Details(exec::Application& application, Component& component, const ToText& to_text)
      : interface_(component.interface()), to_text_(to_text) {
    std::vector<Member> members;
    for (const auto* one : interface_.properties) members.push_back({&component, one});
    for (const auto* one : interface_.inputs) members.push_back({&component, nullptr, one});
    for (const auto* one : interface_.outputs) {
      members.push_back({&component, nullptr, nullptr, one});
    }
    if (to_text_) readings_ = read_members(application, members);
    details_.status = to_text_ ? remote::status_of(application, component)
                               : status_without_reason(application, component);
    details_.activity = activity_text(thread_of(application, component).activity);
    details_.answered = readings_.has_value();
  }

  ComponentDetails take() {
    for (const auto* one : interface_.properties) details_.properties.push_back(property(*one));
    for (const auto* one : interface_.inputs) details_.inputs.push_back(input(*one));
    for (const auto* one : interface_.outputs) details_.outputs.push_back(output(*one));
    for (const auto* one : interface_.operations) details_.operations.push_back(operation(*one));
    for (const auto* one : interface_.events) details_.events.push_back(event(*one));
    for (const auto* one : interface_.callers) {
      details_.requirements.push_back(requirement(*one, one->signature(), one->target()));
      details_.requirements.back().command = one->needs_command();
    }
    for (const auto* one : interface_.handlers) {
      details_.requirements.push_back(requirement(*one, one->signature(), one->source()));
      details_.requirements.back().event = true;
    }
    for (const auto* one : interface_.machines) details_.machines.push_back(machine(*one));
    return std::move(details_);
  }

 private:
  /// Of the next member in the order in which they were read; nothing if nobody answered.
  const Reading* next_reading() { return readings_ ? &(*readings_)[next_++] : nullptr; }

  PropertyDetails property(const component::PropertyBase& from) {
    PropertyDetails to;
    to.name = from.name();
    to.doc = types::doc_with_enumerators(from.doc(), from.type());
    to.type = from.type().name;
    to.unit = from.unit();
    if (const auto& range = from.limits()) {
      to.limited = true;
      to.low = range->low;
      to.high = range->high;
    }
    to.persistent = from.persistent();
    to.changeable = from.changeable();
    to.mandatory = from.is_mandatory();
    if (const Reading* const reading = next_reading()) {
      to.value = to_text_(from.type(), reading->whole.data());
    }
    add_fields(from.type(), details_.fields);
    return to;
  }

  PortDetails port(const component::PortBase& from) {
    PortDetails to;
    to.name = from.name();
    to.doc = types::doc_with_enumerators(from.doc(), from.type());
    to.type = from.type().name;
    to.unit = from.unit();
    const bool sized = from.declared_size().declared();
    to.size = sized ? static_cast<std::int32_t>(from.declared_size().value()) : -1;
    if (const Reading* const reading = next_reading()) {
      to.written = reading->written;
      to.age = reading->written ? base::to_seconds(reading->age) : 0.0;
      if (reading->written) to.value = to_text_(from.type(), reading->whole.data());
    }
    add_fields(from.type(), details_.fields);
    return to;
  }

  PortDetails input(const component::InputPortBase& from) {
    PortDetails to = port(from);
    for (const auto* writer : from.writers()) to.peers.push_back(joined(*writer));
    to.max_age = base::to_seconds(from.max_age());
    to.when_stale = component::name_of(from.stale_reaction());
    to.triggers = from.triggers();
    return to;
  }

  PortDetails output(const component::OutputPortBase& from) {
    PortDetails to = port(from);
    for (const auto* reader : from.readers()) to.peers.push_back(joined(*reader));
    return to;
  }

  static OperationDetails operation(const component::OperationBase& from) {
    OperationDetails to;
    to.name = from.name();
    to.doc = from.doc();
    const component::Signature& signature = from.signature();
    to.signature = signature.text();
    for (const auto& argument : signature.arguments) {
      to.arguments.push_back({std::string(argument.name), argument.type->name});
    }
    if (signature.result != nullptr) to.result = signature.result->name;
    to.command = from.is_command();
    to.by_operator = from.is_by_operator();
    return to;
  }

  static EventDetails event(const component::EventBase& from) {
    EventDetails to{std::string(from.name()), std::string(from.doc()), from.signature().text(), {}};
    for (const auto* handler : from.subscribers()) {
      to.subscribers.push_back(handler->owner().name());
    }
    return to;
  }

  template <typename Target>
  static RequirementDetails requirement(const component::Requirement& from,
                                        const component::Signature& signature,
                                        const Target* target) {
    RequirementDetails to;
    to.name = from.name();
    to.doc = from.doc();
    to.signature = signature.text();
    to.optional = from.is_optional();
    if (target != nullptr) to.bound_to = joined(*target);
    return to;
  }

  static MachineDetails machine(const component::StateMachine& from) {
    MachineDetails to{from.name(), from.doc(), {}, std::string(from.path())};
    for (std::size_t i = 0; i < from.table().states.size(); ++i) {
      to.states.push_back(from.table().path(static_cast<int>(i)));
    }
    return to;
  }

  static std::string joined(const auto& member) {
    return member.owner().name() + "." + std::string(member.name());
  }

  const component::Interface& interface_;
  const ToText& to_text_;
  ComponentDetails details_;
  std::optional<std::vector<Reading>> readings_;
  std::size_t next_ = 0;
};

const char* kind_of(const Member& member) {
  if (member.input != nullptr) return "input";
  if (member.output != nullptr) return "output";
  return member.property->persistent() ? "property" : "attribute";
}

ItemValue no_value(const std::string& item, const std::string& error) {
  ItemValue value;
  value.item = item;
  value.error = error;
  return value;
}

/// @param reading  none: nobody answered
ItemValue value_of(const Item& item, const Reading* reading, const ToText& to_text) {
  ItemValue value = no_value(item.text, {});
  value.kind = kind_of(item.member);
  value.type = item.type->name;
  value.unit = item.unit;
  if (reading == nullptr) {
    value.error = "the thread of '" + item.member.component->name() + "' does not answer";
    return value;
  }
  value.written = reading->written;
  if (!reading->written) return value;
  value.age = base::to_seconds(reading->age);
  const void* const part = part_of(item, reading->whole);
  if (part == nullptr) {
    value.error = "'" + item.text + "' is not there: it is " +
                  to_text(item.member.type(), reading->whole.data());
  } else {
    value.value = to_text(*item.type, part);
  }
  return value;
}

bool is_simulated(const exec::Application& application) {
  const auto& components = application.blueprint().components;
  return !components.empty() && components.front().component->context().simulated;
}

/// The present one; empty if there are none.
std::string mode_of(exec::Application& application) {
  if (application.plan().modes.empty()) return {};
  const auto mode = application.value_of(exec::kModesName, "mode");
  return mode ? mode.value().text() : std::string();
}

}  // namespace

ApplicationStatus status_of(exec::Application& application) {
  ApplicationStatus status;
  status.name = application.blueprint().name;
  status.time = base::to_seconds(application.now() - base::Time{});
  status.simulated = is_simulated(application);
  status.mode = mode_of(application);
  status.faults = application.faults();
  status.reactions = application.reactions();
  const std::vector<exec::ThreadStatistics> threads = application.thread_statistics();
  for (std::size_t i = 0; i < threads.size(); ++i) {
    const exec::ThreadPlan& plan = application.plan().threads[i];
    if (!plan.members.empty()) status.threads.push_back(status_of(threads[i], plan));
  }
  return status;
}

ComponentStatus status_of(exec::Application& application, Component& component) {
  return statuses_of(application, {&component}).front();
}

Components all_components(const exec::Application& application) {
  Components all;
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    all.push_back(entry.component.get());
  }
  return all;
}

std::vector<ComponentStatus> statuses_of(exec::Application& application,
                                         const Components& components) {
  std::vector<ComponentStatus> all;
  std::map<const component::ExecutionContext*, std::vector<std::size_t>> resting;
  for (std::size_t i = 0; i < components.size(); ++i) {
    all.push_back(status_without_reason(application, *components[i]));
    if (!runs(all.back())) resting[&components[i]->context()].push_back(i);
  }
  // Each thread is asked once: one that hangs is waited for once.
  for (const auto& [context, indices] : resting) {
    Components asked;
    for (const std::size_t i : indices) asked.push_back(components[i]);
    const std::vector<std::string> reasons = reasons_of(application, asked);
    for (std::size_t k = 0; k < indices.size(); ++k) all[indices[k]].reason = reasons[k];
  }
  return all;
}

Faults faults_of(exec::Application& application, const Components& components) {
  Components resting;
  std::copy_if(components.begin(), components.end(), std::back_inserter(resting),
               [](const Component* one) { return one->state() != component::State::kRunning; });
  return {application.faults(), application.reactions(), statuses_of(application, resting)};
}

ComponentDetails details_of(exec::Application& application, Component& component,
                            const ToText& to_text) {
  return Details(application, component, to_text).take();
}

std::vector<ItemValue> values_of(exec::Application& application,
                                 const std::vector<std::string>& texts, const ToText& to_text) {
  std::vector<ItemValue> values(texts.size());
  std::map<const Component*, std::vector<std::pair<Item, std::size_t>>> by_component;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const base::Result<Item> item = find_item(application, texts[i]);
    if (item) {
      by_component[item.value().member.component].emplace_back(item.value(), i);
    } else {
      values[i] = no_value(texts[i], item.error());
    }
  }
  for (const auto& [component, items] : by_component) {
    std::vector<Member> members;
    for (const auto& [item, place] : items) members.push_back(item.member);
    const auto readings = read_members(application, members);
    for (std::size_t k = 0; k < items.size(); ++k) {
      const auto& [item, place] = items[k];
      values[place] = value_of(item, readings ? &(*readings)[k] : nullptr, to_text);
    }
  }
  return values;
}

}  // namespace armature::remote
