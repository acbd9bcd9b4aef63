// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/event_command_builder.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/component/interface.hpp"

namespace armature::deploy::internal {
namespace {

using From = component::CallParameter::From;

/// A name that scripts and the task browser can say, where the deployment gives none.
std::string name_of(const Connection& connection) {
  if (!connection.name.empty()) return connection.name;
  std::string name = to_text(connection.from) + "_" + to_text(connection.to);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace

const component::EventBase* EventCommandBuilder::event_of(const Endpoint& end) const {
  const component::Component* const component = find_component(components_, end.component);
  if (component == nullptr) return nullptr;
  // Few have events, and many have thousands of outputs: the name of one is looked for last.
  for (const auto* event : component::interface_of(*component).events) {
    if (event->name() != end.port) continue;
    const auto& outputs = component::interface_of(*component).outputs;
    const auto same = [&](const auto* port) { return port->name() == end.port; };
    return std::ranges::none_of(outputs, same) ? event : nullptr;
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
  const component::EventBase& event = *event_of(connection.from);
  const component::Signature& members = event.signature();
  const Called called{
      connection.to, command->signature(), connection.with, connection.where, {}, &connection.from,
      &members};
  auto parameters = ParameterBuilder(components_, diagnostics_).parameters(called);
  if (!parameters || !simple) return false;
  Wire wire{connection, event, *command, std::move(*parameters)};
  return check_max_age(wire) && make(std::move(wire));
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
  const component::Component* const target =
      component_at(to, components_, blueprint_, diagnostics_);
  if (target == nullptr) return nullptr;
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

bool EventCommandBuilder::make(Wire&& wire) {
  const Connection& connection = wire.connection;
  const std::string name = name_of(connection);
  if (find_component(components_, name) != nullptr) {
    diagnostics_.error(connection.where, in_quotes(name) + " is already the name of a component",
                       "give this one another: name: Follow");
    return false;
  }
  connect_parameters(wire.parameters, name, keeps_running_, connection.where, blueprint_);
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
