// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/event_command_builder.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/base/unit.hpp"
#include "armature/component/interface.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/property_value.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {
namespace {

using component::Signature;
using From = exec::CommandParameter::From;

/// `position [rad]` is `position`, in rad.
struct NameAndUnit {
  std::string name;
  std::string unit;
};

NameAndUnit parts_of(std::string_view text) {
  const std::size_t open = text.find(" [");
  if (open == std::string_view::npos || !text.ends_with(']')) return {std::string(text), {}};
  return {std::string(text.substr(0, open)),
          std::string(text.substr(open + 2, text.size() - open - 3))};
}

/// Arguments that nobody named are called by their number.
NameAndUnit argument(const Signature& signature, std::size_t index) {
  NameAndUnit named = parts_of(signature.arguments[index].name);
  if (named.name.empty()) named.name = "argument" + std::to_string(index + 1);
  return named;
}

std::vector<std::string> names_of(const Signature& signature) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < signature.arguments.size(); ++i) {
    names.push_back(argument(signature, i).name);
  }
  return names;
}

std::optional<std::size_t> find_argument(const Signature& signature, std::string_view name) {
  const std::vector<std::string> names = names_of(signature);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

bool same_unit(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const auto first = base::parse_unit(a);
  const auto second = base::parse_unit(b);
  return first && second && first.value().same_as(second.value());
}

std::string in_unit(const types::Type& type, std::string_view unit) {
  return type.name + (unit.empty() ? "" : " in " + in_quotes(unit));
}

template <typename List>
std::vector<std::string> member_names(const List& members) {
  std::vector<std::string> names;
  for (const auto* member : members) names.emplace_back(member->name());
  return names;
}

const component::OutputPortBase* output_of(const component::Component& component,
                                           std::string_view name) {
  for (const auto* port : component::interface_of(component).outputs) {
    if (port->name() == name) return port;
  }
  return nullptr;
}

/// A name that scripts and the task browser can say, where the deployment gives none.
std::string name_of(const Connection& connection) {
  if (!connection.name.empty()) return connection.name;
  std::string name = to_text(connection.from) + "_" + to_text(connection.to);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace

const component::Component* EventCommandBuilder::component_of(const std::string& name) const {
  const auto found = components_.find(name);
  return found == components_.end() ? nullptr : found->second;
}

const component::EventBase* EventCommandBuilder::event_of(const Endpoint& end) const {
  const component::Component* const component = component_of(end.component);
  if (component == nullptr) return nullptr;
  // Few have events, and many have thousands of outputs: the name of one is looked for last.
  for (const auto* event : component::interface_of(*component).events) {
    if (event->name() != end.port) continue;
    return output_of(*component, end.port) == nullptr ? event : nullptr;
  }
  return nullptr;
}

void EventCommandBuilder::add(const Connection& connection) {
  if (!try_add(connection)) blueprint_.absent.insert(name_of(connection));
}

bool EventCommandBuilder::try_add(const Connection& connection) {
  const bool simple = check_policy(connection);
  const component::CommandBase* const command = command_of(connection);
  if (command == nullptr) return false;
  Wire wire{connection, *event_of(connection.from), *command, {}};
  bool complete = check_names(wire) && simple;
  for (std::size_t i = 0; i < command->signature().arguments.size(); ++i) {
    auto one = parameter(wire, i);
    complete = complete && one;
    if (one) wire.parameters.push_back(std::move(*one));
  }
  complete = complete && check_max_age(wire);
  return complete && make(std::move(wire));
}

/// Only what comes by ports has an age.
bool EventCommandBuilder::check_max_age(const Wire& wire) {
  const auto is_port = [](const Parameter& one) { return one.from == From::kPort; };
  if (!wire.connection.policy.max_age || std::ranges::any_of(wire.parameters, is_port)) return true;
  diagnostics_.error(
      wire.connection.where,
      "max_age has no effect: no parameter of " + path(wire.connection.to) + " comes from a port",
      "leave it out");
  return false;
}

bool EventCommandBuilder::check_policy(const Connection& connection) {
  const ConnectionPolicy& policy = connection.policy;
  const bool plain = policy.kind == ConnectionPolicy::Kind::kLatest && !policy.one_cycle_delay &&
                     !policy.fan_in && !policy.on_old && !policy.on_lost;
  if (plain) return true;
  diagnostics_.error(connection.where,
                     path(connection.from) +
                         " is an event, and an event that commands has no other policy than "
                         "max_age, of the ports that its parameters come from",
                     "leave out policy, on_old, on_lost, delay and fan_in");
  return false;
}

const component::CommandBase* EventCommandBuilder::command_of(const Connection& connection) {
  const Endpoint& to = connection.to;
  const component::Component* const target = component_of(to.component);
  if (target == nullptr) {
    if (blueprint_.absent.count(to.component) > 0) return nullptr;
    std::vector<std::string> names;
    for (const auto& [name, component] : components_) names.emplace_back(name);
    std::sort(names.begin(), names.end());
    diagnostics_.error(to.where, "unknown component " + in_quotes(to.component),
                       base::suggestion(to.component, names));
    return nullptr;
  }
  for (const auto* operation : component::interface_of(*target).operations) {
    if (operation->name() != to.port || !operation->is_command()) continue;
    if (operation->is_by_operator()) {
      diagnostics_.error(to.where, path(to) + " is an act of the operator: no event does it",
                         "do it at the prompt of the task browser, or in a script that it is "
                         "granted to");
      return nullptr;
    }
    if (!operation->is_offered()) {
      diagnostics_.error(to.where, operation->why_not_offered());
      return nullptr;
    }
    return static_cast<const component::CommandBase*>(operation);
  }
  refuse_target(connection, *target);
  return nullptr;
}

void EventCommandBuilder::refuse_target(const Connection& connection,
                                        const component::Component& target) {
  const Endpoint& to = connection.to;
  const component::Interface& interface = component::interface_of(target);
  const auto has = [&](const auto& members) {
    return std::ranges::any_of(members,
                               [&](const auto* member) { return member->name() == to.port; });
  };
  std::vector<std::string> commands;
  for (const auto* operation : interface.operations) {
    if (operation->is_command()) commands.emplace_back(operation->name());
  }
  const std::string event = path(connection.from) + " is an event, and gives a command; ";
  if (has(interface.inputs)) {
    diagnostics_.error(to.where, event + path(to) + " is an input port");
  } else if (has(interface.handlers)) {
    diagnostics_.error(to.where, event + path(to) + " is a handler of events",
                       "have " + in_quotes(to.component) + " handle it by its peers: peers: [" +
                           connection.from.component + "]");
  } else if (has(interface.operations)) {
    diagnostics_.error(to.where, event + path(to) + " is an operation, whose end nobody is told");
  } else {
    diagnostics_.error(to.where, in_quotes(to.component) + " has no command " + in_quotes(to.port),
                       base::suggestion(to.port, commands));
  }
}

/// Every name in `with` is one of the command's parameters.
bool EventCommandBuilder::check_names(const Wire& wire) {
  const std::vector<std::string> known = names_of(wire.command.signature());
  bool good = true;
  for (const Property& written : wire.connection.with) {
    if (std::find(known.begin(), known.end(), written.name) != known.end()) continue;
    good = false;
    diagnostics_.error(written.where,
                       path(wire.connection.to) + " has no parameter " + in_quotes(written.name),
                       base::suggestion(written.name, known));
  }
  return good;
}

/// Every parameter is given by name: in `with`, or as a member of the event.
bool EventCommandBuilder::are_named(const Wire& wire) {
  const std::vector<std::string> wanted = names_of(wire.command.signature());
  return std::ranges::all_of(wanted, [&](const std::string& name) {
    return find(wire.connection.with, name) != nullptr ||
           find_argument(wire.event.signature(), name).has_value();
  });
}

/// As `with` says; else the event's member of that name; where nothing is said and the names do not
/// fit, the one at the same place.
std::optional<exec::CommandParameter> EventCommandBuilder::parameter(const Wire& wire,
                                                                     std::size_t index) {
  const NameAndUnit wanted = argument(wire.command.signature(), index);
  if (const types::Type& type = *wire.command.signature().arguments[index].type; type.sealed) {
    diagnostics_.error(wire.connection.to.where,
                       path(wire.connection.to) + " takes a " + type.name +
                           ", which its own class gives a component that may have it: no event "
                           "gives this command");
    return std::nullopt;
  }
  const Property* const written = find(wire.connection.with, wanted.name);
  if (written != nullptr) return given(wire, index, *written);
  const Signature& event = wire.event.signature();
  const base::Location& where = wire.connection.where;
  const bool one_by_one = wire.connection.with.empty() && !are_named(wire) &&
                          event.arguments.size() == wire.command.signature().arguments.size();
  if (one_by_one) return from_member(wire, index, index, where);
  if (const auto named = find_argument(event, wanted.name)) {
    return from_member(wire, index, *named, where);
  }
  diagnostics_.error(
      where,
      "nothing gives the parameter " + in_quotes(wanted.name) + " of " + path(wire.connection.to),
      "say where it comes from: with: {" + wanted.name +
          ": a value, Component.Port or a member of the event}");
  return std::nullopt;
}

std::optional<exec::CommandParameter> EventCommandBuilder::given(const Wire& wire,
                                                                 std::size_t index,
                                                                 const Property& written) {
  const Value& value = written.value;
  if (value.kind == Value::Kind::kText && !value.literal) {
    const auto [component, port] = split_last_dot(value.text);
    if (component_of(component) != nullptr) return from_port(wire, index, value);
    if (const auto member = find_argument(wire.event.signature(), value.text)) {
      return from_member(wire, index, *member, value.where);
    }
  }
  const NameAndUnit wanted = argument(wire.command.signature(), index);
  const types::Type& type = *wire.command.signature().arguments[index].type;
  const std::string subject =
      "parameter " + in_quotes(wanted.name) + " of " + path(wire.connection.to);
  auto constant = make_value(value, type, wanted.unit, subject, diagnostics_);
  if (!constant) return std::nullopt;
  Parameter made;
  made.from = From::kConstant;
  made.constant = std::make_shared<const types::Value>(std::move(*constant));
  return made;
}

std::optional<exec::CommandParameter> EventCommandBuilder::from_member(
    const Wire& wire, std::size_t index, std::size_t member, const base::Location& where) {
  const Signature& event = wire.event.signature();
  const NameAndUnit has = argument(event, member);
  const Offer offer{in_quotes(has.name) + " of " + path(wire.connection.from),
                    *event.arguments[member].type, has.unit, where,
                    "give it a value of that type and unit in with"};
  if (!fits(wire, index, offer)) return std::nullopt;
  Parameter made;
  made.member = member;
  return made;
}

/// Its type and unit are those of the parameter, or it is a number that becomes one of them.
bool EventCommandBuilder::fits(const Wire& wire, std::size_t index, const Offer& offer) {
  const NameAndUnit wants = argument(wire.command.signature(), index);
  const types::Type& wanted = *wire.command.signature().arguments[index].type;
  if (exec::EventCommand::takes(wanted, offer.type) && same_unit(offer.unit, wants.unit))
    return true;
  diagnostics_.error(offer.where,
                     offer.what + " is " + in_unit(offer.type, offer.unit) + ", but " +
                         in_quotes(wants.name) + " of " + path(wire.connection.to) + " is " +
                         in_unit(wanted, wants.unit),
                     offer.hint);
  return false;
}

std::optional<exec::CommandParameter> EventCommandBuilder::from_port(const Wire& wire,
                                                                     std::size_t index,
                                                                     const Value& written) {
  const auto [name, port_name] = split_last_dot(written.text);
  const component::Component& owner = *component_of(name);
  const component::OutputPortBase* const port = output_of(owner, port_name);
  if (port == nullptr) {
    diagnostics_.error(
        written.where, in_quotes(name) + " has no output port " + in_quotes(port_name),
        base::suggestion(port_name, member_names(component::interface_of(owner).outputs)));
    return std::nullopt;
  }
  const Offer offer{in_quotes(written.text), port->type(), std::string(port->unit()), written.where,
                    "connect it to a component that converts it, and take that one's output"};
  if (!fits(wire, index, offer)) return std::nullopt;
  Parameter made;
  made.from = From::kPort;
  made.input = argument(wire.command.signature(), index).name;
  made.port = port;
  return made;
}

bool EventCommandBuilder::make(Wire&& wire) {
  const Connection& connection = wire.connection;
  const std::string name = name_of(connection);
  if (component_of(name) != nullptr) {
    diagnostics_.error(connection.where, in_quotes(name) + " is already the name of a component",
                       "give this one another: name: Follow");
    return false;
  }
  std::optional<component::OnLost> on_lost;
  if (keeps_running_) on_lost = component::on_lost(component::Reaction::kHold);
  for (const Parameter& parameter : wire.parameters) {
    if (parameter.port == nullptr) continue;
    blueprint_.connections.push_back({parameter.port->owner().name(),
                                      parameter.port->name(),
                                      name,
                                      parameter.input,
                                      {},
                                      {},
                                      on_lost,
                                      connection.where});
  }
  exec::ComponentEntry entry =
      exec::event_command_entry(name, wire.event, wire.command, std::move(wire.parameters),
                                connection.policy.max_age.value_or(base::Duration::zero()),
                                connection.from.where, connection.to.where);
  entry.where = connection.where;
  blueprint_.components.push_back(std::move(entry));
  const component::Component& made = *blueprint_.components.back().component;
  components_.emplace(made.name(), &made);
  return true;
}

}  // namespace armature::deploy::internal
