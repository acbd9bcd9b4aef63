// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/deploy/internal/connection_builder.hpp"
#include "armature/deploy/internal/event_command_builder.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;
ConnectionBuilder::ConnectionBuilder(const Document& document, exec::Blueprint& blueprint,
                                     base::Diagnostics& diagnostics)
    : document_(document), blueprint_(blueprint), diagnostics_(diagnostics) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    components_.emplace(entry.component->name(), entry.component.get());
  }
}

void ConnectionBuilder::build() {
  blueprint_.connections.reserve(document_.connections.size());
  add_connections();
  for (const NamedConnection& named : document_.named_connections) add_named(named);
  for (const auto* inputs : {&document_.network.inputs, &document_.operator_inputs}) {
    for (const Connection& input : *inputs) {
      const bool known =
          ports_of(input.from.component) != nullptr && this->input(input.to) != nullptr;
      if (known) add(input.from, input.to, input.policy, input.where);
    }
  }
  apply_delays();
}

/// What gives a command has events of its own, so one may begin where another one ends.
void ConnectionBuilder::add_connections() {
  EventCommandBuilder commands(blueprint_, components_, document_.on_fault == OnFault::kKeepRunning,
                               diagnostics_);
  std::vector<const Connection*> open;
  for (const Connection& connection : document_.connections) open.push_back(&connection);
  for (std::size_t before = 0; before != open.size();) {
    before = open.size();
    std::erase_if(open, [&](const Connection* connection) {
      const bool is_one = commands.is_one(*connection);
      if (is_one) commands.add(*connection);
      return is_one;
    });
  }
  for (const Connection* connection : open) {
    add(connection->from, connection->to, connection->policy, connection->where);
    check_is_command(*connection);
  }
}

void ConnectionBuilder::check_is_command(const Connection& connection) {
  if (connection.name.empty() && connection.with.empty()) return;
  const bool known = components_.find(connection.from.component) != components_.end();
  if (!known) return;  // which the plan tells
  diagnostics_.error(connection.where,
                     path(connection.from) + " is no event, and only an event that commands has " +
                         (connection.with.empty() ? "a name" : "parameters"),
                     "leave out name and with, or begin at an event");
}

void ConnectionBuilder::add(const Endpoint& from, const Endpoint& to,
                            const ConnectionPolicy& policy, const base::Location& where) {
  exec::ConnectionEntry entry{from.component, from.port, to.component, to.port,
                              policy,         {},        {},           where};
  if (policy.max_age) entry.max_age = max_age_of(to, policy);
  const bool keep_running = document_.on_fault == OnFault::kKeepRunning;
  if (policy.on_lost || keep_running) {
    entry.on_lost = component::on_lost(policy.on_lost.value_or(Reaction::kHold));
  }
  if (policy.fan_in) check_fan_in(to, where);
  blueprint_.connections.push_back(std::move(entry));
}

void ConnectionBuilder::add_named(const NamedConnection& named) {
  const Ends ends = ends_of(named);
  for (const Endpoint* output : ends.outputs) {
    for (const Endpoint* input : ends.inputs) add(*output, *input, named.policy, named.where);
  }
  const bool useless = ends.outputs.empty() || ends.inputs.empty();
  const bool reported = !ends.complete || named.ports.size() < 2;
  if (!useless || reported) return;
  diagnostics_.error(named.where,
                     "connection " + in_quotes(named.name) + " has no " +
                         (ends.outputs.empty() ? "output" : "input") +
                         " port, so nothing flows along it",
                     "name the same connection for a port of the other direction");
}

ConnectionBuilder::Ends ConnectionBuilder::ends_of(const NamedConnection& named) {
  Ends ends;
  for (const Endpoint& end : named.ports) {
    const Ports* ports = ports_of(end.component);
    if (ports != nullptr && ports->outputs.count(end.port) > 0) {
      ends.outputs.push_back(&end);
    } else if (ports != nullptr && ports->inputs.count(end.port) > 0) {
      ends.inputs.push_back(&end);
    } else {
      report_end(named, end, ports);
      ends.complete = false;
    }
  }
  return ends;
}

void ConnectionBuilder::report_end(const NamedConnection& named, const Endpoint& end,
                                   const Ports* ports) {
  if (blueprint_.absent.count(end.component) > 0) return;
  std::vector<std::string> names;
  if (ports == nullptr) {
    for (const exec::ComponentEntry& entry : blueprint_.components) {
      names.push_back(entry.component->name());
    }
    diagnostics_.error(
        end.where,
        "connection " + in_quotes(named.name) + ": unknown component " + in_quotes(end.component),
        base::suggestion(end.component, names));
    return;
  }
  const component::Interface& interface = component::interface_of(*components_.at(end.component));
  for (const auto* port : interface.outputs) names.push_back(port->name());
  for (const auto* port : interface.inputs) names.push_back(port->name());
  diagnostics_.error(end.where,
                     "connection " + in_quotes(named.name) + ": " + in_quotes(end.component) +
                         " has no port " + in_quotes(end.port),
                     base::suggestion(end.port, names));
}

void ConnectionBuilder::apply_delays() {
  std::unordered_map<std::string, std::unordered_map<std::string, bool>> delays;
  for (const Component& component : document_.components) {
    for (const Reference& delay : component.delays) delays[component.name][delay.name] = false;
  }
  if (delays.empty()) return;
  for (exec::ConnectionEntry& entry : blueprint_.connections) {
    const auto reader = delays.find(entry.to_component);
    if (reader == delays.end()) continue;
    const auto writer = reader->second.find(entry.from_component);
    if (writer == reader->second.end()) continue;
    entry.policy.one_cycle_delay = true;
    writer->second = true;
  }
  for (const Component& component : document_.components) {
    for (const Reference& delay : component.delays) {
      const bool used = delays[component.name][delay.name];
      if (used || blueprint_.absent.count(delay.name) > 0) continue;
      diagnostics_.error(
          delay.where,
          in_quotes(component.name) + " delays the data of " + in_quotes(delay.name) +
              ", but reads none of its outputs",
          "connect an output of " + in_quotes(delay.name) + " to it, or remove the delay");
    }
  }
}

void ConnectionBuilder::check_fan_in(const Endpoint& to, const base::Location& where) {
  const component::InputPortBase* const port = input(to);
  if (port == nullptr || port->allows_fan_in()) return;
  diagnostics_.error(where, path(to) + " takes one writer: its component does not declare fan_in",
                     "remove fan_in, or connect the writers to inputs of their own");
}

/// What happens with old data is the port's affair unless the document says it.
component::MaxAge ConnectionBuilder::max_age_of(const Endpoint& to,
                                                const ConnectionPolicy& policy) {
  const component::InputPortBase* const port = input(to);
  const component::Reaction own =
      port != nullptr ? port->stale_reaction() : component::Reaction::kStop;
  return component::max_age(*policy.max_age, policy.on_old.value_or(own));
}

component::InputPortBase* ConnectionBuilder::input(const Endpoint& end) {
  const Ports* ports = ports_of(end.component);
  if (ports == nullptr) return nullptr;
  const auto found = ports->inputs.find(end.port);
  return found == ports->inputs.end() ? nullptr : found->second;
}

const ConnectionBuilder::Ports* ConnectionBuilder::ports_of(const std::string& component) {
  const auto found = components_.find(component);
  if (found == components_.end()) return nullptr;
  const auto [ports, fresh] = ports_.try_emplace(found->second);
  if (fresh) {
    const component::Interface& interface = component::interface_of(*found->second);
    for (auto* port : interface.inputs) ports->second.inputs.emplace(port->name(), port);
    for (auto* port : interface.outputs) ports->second.outputs.emplace(port->name(), port);
  }
  return &ports->second;
}

}  // namespace armature::deploy::internal
