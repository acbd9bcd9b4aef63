// SPDX-License-Identifier: Apache-2.0
#include "armature/script/internal/help.hpp"

#include <algorithm>
#include <cstdio>

#include "armature/base/near_name.hpp"
#include "armature/base/seconds.hpp"
#include "armature/script/internal/items.hpp"

namespace armature::script::internal {
namespace {

using component::Component;

/// An entry of help: what it is about, and behind an indent what there is to say.
std::string entry(const Paper& paper, const std::string& head, const std::string& text) {
  std::string lines = "\n  " + wrapped(paper, head, 6, 2);
  if (!text.empty()) lines += "\n      " + wrapped(paper, text, 6, 6);
  return lines;
}

std::string number_text(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

void add_part(std::string& text, const std::string& part) {
  text += (text.empty() ? "" : "; ") + part;
}

std::string joined_names(const auto& items) {
  std::string text;
  for (const auto* one : items) {
    text += (text.empty() ? "" : ", ") + one->owner().name() + "." + std::string(one->name());
  }
  return text;
}

std::string about_property(const component::PropertyBase& property) {
  std::string text(property.doc());
  add_part(text, property.type().name);
  if (const auto& range = property.limits()) {
    add_part(text, number_text(range->low) + " to " + number_text(range->high));
  }
  if (property.changeable()) {
    add_part(text, "may change while it runs");
  } else if (property.persistent()) {
    add_part(text, "changes only while stopped");
  }
  return text;
}

std::string type_with_size(const component::PortBase& port) {
  const bool sized = port.declared_size().declared();
  return port.type().name +
         (sized ? " of " + std::to_string(port.declared_size().value()) + " elements" : "");
}

std::string about_input(const component::InputPortBase& port) {
  std::string text(port.doc());
  add_part(text, type_with_size(port));
  const std::string writers = joined_names(port.writers());
  add_part(text, writers.empty() ? "not connected" : "from " + writers);
  if (port.max_age() > base::Duration::zero()) {
    add_part(text, "at most " + number_text(1000.0 * base::to_seconds(port.max_age())) +
                       " ms old, else " + std::string(component::name_of(port.stale_reaction())));
  }
  return text;
}

std::string about_output(const component::OutputPortBase& port) {
  std::string text(port.doc());
  add_part(text, type_with_size(port));
  const std::string readers = joined_names(port.readers());
  add_part(text, readers.empty() ? "not connected" : "to " + readers);
  return text;
}

std::string call_text(const component::OperationBase& operation) {
  std::string text = in_lua(operation.owner().name()) + ":" + std::string(operation.name()) + "(";
  const auto& arguments = operation.signature().arguments;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    text += (i > 0 ? ", " : "") +
            (arguments[i].name.empty() ? arguments[i].type->name : std::string(arguments[i].name));
  }
  return text + ")";
}

std::string about_operation(const component::OperationBase& operation) {
  std::string text(operation.doc());
  std::string types;
  for (const auto& argument : operation.signature().arguments) {
    types += (types.empty() ? "takes " : ", ") + argument.type->name;
  }
  if (!types.empty()) add_part(text, types);
  if (operation.signature().result != nullptr) {
    add_part(text, "gives " + operation.signature().result->name);
  }
  if (operation.is_command()) add_part(text, "a command: it goes on after it was accepted");
  if (operation.is_by_operator()) add_part(text, "an act of the operator");
  return text;
}

std::string about_event(const component::EventBase& event) {
  std::string text(event.doc());
  std::string told;
  for (const auto* handler : event.subscribers()) {
    told += (told.empty() ? "told " : ", ") + handler->owner().name();
  }
  if (!told.empty()) add_part(text, told);
  return text;
}

/// `Name = value unit` of a member with a value.
std::string with_value(const Member& member, const Reading* reading) {
  const std::string name(member.property != nullptr ? member.property->name()
                                                    : std::string_view(member.port()->name()));
  if (reading == nullptr) return name;
  if (!reading->written) return name + ", not yet written";
  return name + " = " + value_text(member.type(), reading->whole.data(), member.unit());
}

std::string about(const Member& member) {
  if (member.property != nullptr) return about_property(*member.property);
  if (member.input != nullptr) return about_input(*member.input);
  if (member.output != nullptr) return about_output(*member.output);
  if (member.operation != nullptr) return about_operation(*member.operation);
  return about_event(*member.event);
}

/// The members of one component with their values, which are read at one moment.
class Sections {
 public:
  Sections(const Paper& paper, exec::Application& application, const Component& component)
      : paper_(paper), application_(application) {
    const component::Interface& interface = component.interface();
    for (const auto* one : interface.properties) values_.push_back({&component, one});
    for (const auto* one : interface.inputs) values_.push_back({&component, nullptr, one});
    for (const auto* one : interface.outputs) {
      values_.push_back({&component, nullptr, nullptr, one});
    }
    readings_ = read_members(application_, values_);
  }

  std::string values(const char* heading, auto chosen) const {
    std::string text;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!chosen(values_[i])) continue;
      const Reading* const reading = readings_ ? &(*readings_)[i] : nullptr;
      text += entry(paper_, with_value(values_[i], reading), about(values_[i]));
    }
    return text.empty() ? text : "\n" + inked(paper_, Ink::kHeading, heading) + text;
  }

  std::string operations(const char* heading, const Component& component, bool commands) const {
    std::string text;
    for (const auto* one : component.interface().operations) {
      if (one->is_command() != commands) continue;
      text += entry(paper_, call_text(*one), about_operation(*one));
    }
    return text.empty() ? text : "\n" + inked(paper_, Ink::kHeading, heading) + text;
  }

  std::string events(const Component& component) const {
    std::string text;
    for (const auto* one : component.interface().events) {
      text += entry(paper_, std::string(one->name()) + ", " + one->signature().text(),
                    about_event(*one));
    }
    return text.empty() ? text : "\n" + inked(paper_, Ink::kHeading, "Events") + text;
  }

 private:
  const Paper& paper_;
  exec::Application& application_;
  std::vector<Member> values_;
  std::optional<std::vector<Reading>> readings_;
};

std::string state_machines(const Paper& paper, const Component& component) {
  std::string text;
  for (const auto* machine : component.interface().machines) {
    const std::string path(machine->path());
    std::string states;
    for (std::size_t i = 0; i < machine->table().states.size(); ++i) {
      states += (i == 0 ? "states " : ", ") + machine->table().path(static_cast<int>(i));
    }
    std::string about = machine->doc();
    add_part(about, states);
    text +=
        entry(paper, machine->name() + (path.empty() ? ", in no state" : ", in " + path), about);
  }
  return text.empty() ? text : "\n" + inked(paper, Ink::kHeading, "State machines") + text;
}

std::string help_component(const Paper& paper, exec::Application& application,
                           Component& component) {
  const Sections sections(paper, application, component);
  const std::string reason =
      component.state() == component::State::kRunning ? "" : reason_of(application, component);
  const std::string head = inked(paper, Ink::kHeading, component.name()) + ": " +
                           entry_of(application, component).model + ", " +
                           std::string(component::name_of(component.state())) + ", in thread " +
                           thread_of(application, component).name;
  std::string text = wrapped(paper, head, 2, 0);
  if (!reason.empty()) text += "\n" + wrapped(paper, reason, 0, 0);
  text += sections.values("Properties", [](const Member& one) {
    return one.property != nullptr && one.property->persistent();
  });
  text += sections.values("Attributes", [](const Member& one) {
    return one.property != nullptr && !one.property->persistent();
  });
  text += sections.values("Inputs", [](const Member& one) { return one.input != nullptr; });
  text += sections.values("Outputs", [](const Member& one) { return one.output != nullptr; });
  text += sections.operations("Operations", component, false);
  text += sections.operations("Commands", component, true);
  return text + sections.events(component) + state_machines(paper, component);
}

std::string example_of(const Member& member) {
  if (!member.has_value()) return {};
  const std::string name =
      in_lua(member.component->name()) + member.name().substr(member.component->name().size());
  if (member.property != nullptr) return name + "\n      " + name + " = ...";
  return name + "\n      watch " + member.name() + " every 0.2";
}

std::string help_member(const Paper& paper, exec::Application& application, const Member& member) {
  std::string head = member.name();
  if (member.operation != nullptr) head = call_text(*member.operation);
  if (member.event != nullptr) head += ", " + member.event->signature().text();
  if (member.has_value()) {
    const auto readings = read_members(application, {member});
    const Reading* const reading = readings ? &readings->front() : nullptr;
    head = member.component->name() + "." + with_value(member, reading);
    if (member.port() != nullptr && reading != nullptr && reading->written) {
      head += ", " + number_text(1000.0 * base::to_seconds(reading->age)) + " ms old";
    }
  }
  std::string text = wrapped(paper, head, 6, 0) + "\n      " + wrapped(paper, about(member), 6, 6);
  const std::string example = example_of(member);
  return example.empty() ? text : text + "\n  type:\n      " + example;
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

std::string topics_text(const Paper& paper, const std::vector<Topic>& topics) {
  std::string text;
  for (const Topic& topic : topics)
    text += entry(paper, std::string(topic.usage), std::string(topic.summary));
  return text;
}

/// Operations of that name, whoever has them.
std::string help_by_operation(const Paper& paper, const exec::Application& application,
                              std::string_view name) {
  std::string text;
  for (const exec::ComponentEntry& one : application.blueprint().components) {
    for (const auto* operation : one.component->interface().operations) {
      if (operation->name() != name) continue;
      text += (text.empty() ? "" : "\n") + wrapped(paper, call_text(*operation), 6, 0) +
              "\n      " + wrapped(paper, about_operation(*operation), 6, 6);
    }
  }
  return text;
}

}  // namespace

std::string help_overview(const Paper& paper) {
  return inked(paper, Ink::kHeading, "Values and calls (Lua 5.4)") +
         entry(paper, "Joint1.Position", "shows a property, attribute or port with its unit") +
         entry(paper, "Joint1.GearRatio = 0.02", "sets a property") +
         entry(paper, "Generator:moveTo(array(1.0, 1.0), 10)",
               "calls an operation or begins a command; `wait` waits for its end") +
         entry(paper, "for i = 1, 3 do print(i) end", "any Lua; Ctrl-C interrupts it") + "\n" +
         inked(paper, Ink::kHeading, "Commands") + topics_text(paper, command_topics()) + "\n" +
         inked(paper, Ink::kHeading, "Functions") + topics_text(paper, function_topics()) +
         "\nTab completes names.";
}

base::Result<std::string> help_on(const Paper& paper, exec::Application& application,
                                  std::string_view subject) {
  if (Component* const component = find_component(application, subject)) {
    return help_component(paper, application, *component);
  }
  std::string text;
  for (const auto* topics : {&command_topics(), &function_topics()}) {
    for (const Topic& topic : *topics) {
      if (topic.name != subject && !(topic.name == "ls" && subject == "list")) continue;
      text += (text.empty() ? "" : "\n") + topic_text(paper, topic);
    }
  }
  const std::string operations = help_by_operation(paper, application, subject);
  if (!operations.empty()) text += (text.empty() ? "" : "\n") + operations;
  if (!text.empty()) return text;
  const base::Result<Member> member = find_member(application, subject);
  if (member) return help_member(paper, application, member.value());
  if (subject.find_first_of(".:") != std::string_view::npos) return base::Error{member.error()};
  std::vector<std::string> known = component_names(application);
  for (const auto* topics : {&command_topics(), &function_topics()}) {
    for (const Topic& topic : *topics) known.emplace_back(topic.name);
  }
  const std::string near = base::near_name(subject, known);
  return base::Error{"there is no help on '" + std::string(subject) + "'" +
                     (near.empty() ? "" : " (did you mean '" + near + "'?)")};
}

}  // namespace armature::script::internal
