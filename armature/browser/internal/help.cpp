// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/help.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "armature/base/joined.hpp"
#include "armature/base/near_name.hpp"
#include "armature/base/seconds.hpp"

namespace armature::browser::internal {
namespace {

using inspect::ComponentDescription;
using inspect::EventDescription;
using inspect::MachineDescription;
using inspect::OperationDescription;
using inspect::PortDescription;
using inspect::PropertyDescription;

/// An entry of help: what it is about, and behind an indent what there is to say.
std::string entry(const Paper& paper, const std::string& head, const std::string& text) {
  std::string lines = "\n  " + wrapped(paper, head, 6, 2);
  if (!text.empty()) lines += "\n      " + wrapped(paper, text, 6, 6);
  return lines;
}

std::string short_number(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

void add_part(std::string& text, const std::string& part) {
  text += (text.empty() ? "" : "; ") + part;
}

std::string about(const PropertyDescription& property) {
  std::string text = inspect::doc_with_values(property.doc, property.values);
  add_part(text, property.type);
  if (property.range) {
    add_part(text, short_number(property.range->low) + " to " + short_number(property.range->high));
  }
  if (property.changeable_while_running) {
    add_part(text, "may change while it runs");
  } else if (property.persistent) {
    add_part(text, "changes only while stopped");
  }
  return text;
}

std::string about_port(const PortDescription& port, const char* direction) {
  std::string text = inspect::doc_with_values(port.doc, port.values);
  const std::string size = port.size ? " of " + std::to_string(*port.size) + " elements" : "";
  add_part(text, port.type + size);
  add_part(text, port.peers.empty() ? "not connected" : direction + base::joined(port.peers));
  return text;
}

std::string about(const inspect::InputDescription& port) {
  std::string text = about_port(port, "from ");
  if (port.max_age > base::Duration::zero()) {
    add_part(text, "at most " + short_number(1000.0 * base::to_seconds(port.max_age)) +
                       " ms old, else " + std::string(component::name_of(port.when_stale)));
  }
  return text;
}

std::string about(const inspect::OutputDescription& port) { return about_port(port, "to "); }

std::string call_text(const SpelledView& view, const std::string& component,
                      const OperationDescription& operation) {
  std::string text = view.spelled(component) + ":" + operation.name + "(";
  for (const inspect::ArgumentDescription& argument : operation.arguments) {
    text +=
        (text.back() == '(' ? "" : ", ") + (argument.name.empty() ? argument.type : argument.name);
  }
  return text + ")";
}

std::string about(const OperationDescription& operation) {
  std::string text = operation.doc;
  std::string types;
  for (const inspect::ArgumentDescription& argument : operation.arguments) {
    types += (types.empty() ? "takes " : ", ") + argument.type;
  }
  if (!types.empty()) add_part(text, types);
  if (!operation.result.empty()) add_part(text, "gives " + operation.result);
  if (operation.command) add_part(text, "a command: it goes on after it was accepted");
  if (operation.by_operator) add_part(text, "an act of the operator");
  return text;
}

std::string about(const EventDescription& event) {
  std::string text = event.doc;
  if (!event.subscribers.empty()) add_part(text, "told " + base::joined(event.subscribers));
  return text;
}

/// `Name = value unit` of a member with a value.
std::string with_value(const PropertyDescription& property, bool answered) {
  return answered ? property.name + " = " + with_unit(property.value, property.unit)
                  : property.name;
}

std::string with_value(const PortDescription& port, bool answered) {
  if (!answered) return port.name;
  if (!port.written) return port.name + ", not yet written";
  return port.name + " = " + with_unit(port.value, port.unit);
}

std::string section(const Paper& paper, const char* heading, const std::string& entries) {
  return entries.empty() ? entries : "\n" + inked(paper, Ink::kHeading, heading) + entries;
}

std::string properties(const Paper& paper, const ComponentDescription& component, bool persistent) {
  std::string text;
  for (const PropertyDescription& one : component.properties) {
    if (one.persistent != persistent) continue;
    text += entry(paper, with_value(one, component.answered), about(one));
  }
  return section(paper, persistent ? "Properties" : "Attributes", text);
}

std::string ports(const Paper& paper, const char* heading, const auto& all, bool answered) {
  std::string text;
  for (const auto& one : all) text += entry(paper, with_value(one, answered), about(one));
  return section(paper, heading, text);
}

std::string operations(const Paper& paper, const SpelledView& view,
                       const ComponentDescription& component, bool commands) {
  std::string text;
  for (const OperationDescription& one : component.operations) {
    if (one.command != commands) continue;
    text += entry(paper, call_text(view, component.name, one), about(one));
  }
  return section(paper, commands ? "Commands" : "Operations", text);
}

std::string events(const Paper& paper, const ComponentDescription& component) {
  std::string text;
  for (const EventDescription& one : component.events) {
    text += entry(paper, one.name + ", " + one.signature, about(one));
  }
  return section(paper, "Events", text);
}

std::string state_machines(const Paper& paper, const ComponentDescription& component) {
  std::string text;
  for (const MachineDescription& machine : component.machines) {
    std::string what = machine.doc;
    std::vector<std::string> states;
    for (const auto& state : machine.states) states.push_back(state.path);
    if (!states.empty()) add_part(what, "states " + base::joined(states));
    const std::string where = machine.current.empty() ? ", in no state" : ", in " + machine.current;
    text += entry(paper, machine.name + where, what);
  }
  return section(paper, "State machines", text);
}

std::string help_component(const Paper& paper, SpelledView& view, const std::string& name) {
  const ComponentDescription component = view.look_at(name);
  const std::string head = inked(paper, Ink::kHeading, component.name) + ": " + component.model +
                           ", " + state_name(component) + ", in thread " + component.thread;
  std::string text = wrapped(paper, head, 2, 0);
  if (!component.reason.empty()) text += "\n" + wrapped(paper, component.reason, 0, 0);
  return text + properties(paper, component, true) + properties(paper, component, false) +
         ports(paper, "Inputs", component.inputs, component.answered) +
         ports(paper, "Outputs", component.outputs, component.answered) +
         operations(paper, view, component, false) + operations(paper, view, component, true) +
         events(paper, component) + state_machines(paper, component);
}

const auto* find_in(const auto& members, const std::string& name) {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const auto& one) { return one.name == name; });
  return found == members.end() ? nullptr : &*found;
}

std::string paragraph(const Paper& paper, const std::string& head, const std::string& about) {
  return wrapped(paper, head, 6, 0) + "\n      " + wrapped(paper, about, 6, 6);
}

std::string help_port(const Paper& paper, const std::string& spelled,
                      const ComponentDescription& component, const auto& port) {
  std::string head = component.name + "." + with_value(port, component.answered);
  if (component.answered && port.written) {
    head += ", " + short_number(1000.0 * base::to_seconds(port.age)) + " ms old";
  }
  return paragraph(paper, head, about(port)) + "\n  type:\n      " + spelled + "." + port.name +
         "\n      watch " + component.name + "." + port.name + " every 0.2";
}

std::string help_member(const Paper& paper, SpelledView& view, const MemberName& member) {
  const ComponentDescription component = view.look_at(member.component);
  const std::string spelled = view.spelled(member.component);
  if (const auto* const property = find_in(component.properties, member.member)) {
    const std::string head = member.component + "." + with_value(*property, component.answered);
    const std::string name = spelled + "." + property->name;
    return paragraph(paper, head, about(*property)) + "\n  type:\n      " + name + "\n      " +
           name + " = ...";
  }
  if (const auto* const port = find_in(component.inputs, member.member)) {
    return help_port(paper, spelled, component, *port);
  }
  if (const auto* const port = find_in(component.outputs, member.member)) {
    return help_port(paper, spelled, component, *port);
  }
  if (const auto* const operation = find_in(component.operations, member.member)) {
    return paragraph(paper, call_text(view, member.component, *operation), about(*operation));
  }
  const EventDescription& event = *find_in(component.events, member.member);
  return paragraph(paper, member.component + "." + event.name + ", " + event.signature,
                   about(event));
}

std::string topic_text(const Paper& paper, const Topic& topic) {
  std::string text =
      inked(paper, Ink::kHeading, topic.usage) + "\n      " + wrapped(paper, topic.summary, 6, 6);
  std::string_view rest = topic.detail;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    text += "\n      " + wrapped(paper, rest.substr(0, end), 6, 6);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return text;
}

std::string topics_text(const Paper& paper, std::string_view heading,
                        const std::vector<Topic>& topics) {
  if (topics.empty()) return {};
  std::string text = inked(paper, Ink::kHeading, heading);
  for (const Topic& topic : topics) {
    text += entry(paper, std::string(topic.usage), std::string(topic.summary));
  }
  return text + "\n";
}

/// Operations of that name, whoever has them.
std::string help_by_operation(const Paper& paper, SpelledView& view, const std::string& name) {
  std::string text;
  for (const std::string& component : view.component_names()) {
    const ComponentDescription details = view.interface_of(component);
    const auto* const operation = find_in(details.operations, name);
    if (operation == nullptr) continue;
    text += (text.empty() ? "" : "\n") +
            paragraph(paper, call_text(view, component, *operation), about(*operation));
  }
  return text;
}

}  // namespace

std::string help_overview(const Paper& paper, const Vocabulary& vocabulary) {
  return topics_text(paper, vocabulary.heading, vocabulary.examples) +
         topics_text(paper, "Commands", vocabulary.commands) +
         topics_text(paper, "Functions", vocabulary.functions) + "Tab completes names.";
}

base::Result<std::string> help_on(const Paper& paper, SpelledView& view,
                                  const Vocabulary& vocabulary, std::string_view subject) {
  if (const std::string name = view.find(subject); !name.empty()) {
    return help_component(paper, view, name);
  }
  std::string text;
  std::vector<std::string> known = view.component_names();
  for (const auto* topics : {&vocabulary.commands, &vocabulary.functions}) {
    for (const Topic& topic : *topics) {
      known.emplace_back(topic.name);
      if (topic.name != subject && !(topic.name == "ls" && subject == "list")) continue;
      text += (text.empty() ? "" : "\n") + topic_text(paper, topic);
    }
  }
  const bool of_a_component = subject.find_first_of(".:") != std::string_view::npos;
  const std::string operations =
      of_a_component ? "" : help_by_operation(paper, view, std::string(subject));
  if (!operations.empty()) text += (text.empty() ? "" : "\n") + operations;
  if (!text.empty()) return text;
  if (of_a_component) {
    const base::Result<MemberName> member = view.member_in(subject);
    if (!member) return base::Error{member.error()};
    if (member.value().rest.empty()) return help_member(paper, view, member.value());
    return base::Error{"'" + member.value().component + "." + member.value().member + "' has no '" +
                       member.value().rest + "'"};
  }
  const std::string near = base::near_name(subject, known);
  return base::Error{"no help on '" + std::string(subject) + "'" +
                     (near.empty() ? "" : " (did you mean '" + near + "'?)")};
}

}  // namespace armature::browser::internal
