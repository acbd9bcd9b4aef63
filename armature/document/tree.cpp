// SPDX-License-Identifier: Apache-2.0
#include "armature/document/tree.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "armature/document/value_tree.hpp"

namespace armature::document {

std::string to_text(const Endpoint& endpoint) { return endpoint.component + "." + endpoint.port; }

namespace {

void add(Value& map, std::string key, Value value) {
  map.entries.push_back({std::move(key), std::move(value), {}, {}});
}
void add(Value& map, std::string key, std::string_view text) {
  add(map, std::move(key), make_text(std::string(text)));
}

/// One item alone, several as a list; nothing for none.
void add_items(Value& map, std::string key, std::vector<Value> items) {
  if (items.empty()) return;
  Value list = make_list();
  list.items = std::move(items);
  add(map, std::move(key), std::move(list));
}

Value map_of(std::vector<Property> entries) {
  Value map = make_map();
  map.entries = std::move(entries);
  return map;
}

Value overrun_tree(const Activity& activity) {
  const bool usual = activity.late_cycles_to_fault == exec::Activity().late_cycles_to_fault;
  if (activity.overrun != Overrun::kFault || usual) {
    return make_text(std::string(name_of(activity.overrun)));
  }
  Value map = make_map();
  add(map, "fault", std::to_string(activity.late_cycles_to_fault));
  return map;
}

Value activity_tree(const Activity& activity) {
  Value map = make_map();
  if (activity.kind == Activity::Kind::kPeriodic) {
    add(map, "periodic", to_text(activity.period));
  } else {
    add(map, std::string(name_of(activity.kind)), "true");
  }
  if (activity.priority != 0) add(map, "priority", std::to_string(activity.priority));
  if (activity.scheduler_given) add(map, "scheduler", name_of(activity.scheduler));
  std::vector<Value> cpus;
  for (const int cpu : activity.cpus) cpus.push_back(make_text(std::to_string(cpu)));
  add_items(map, "cpus", std::move(cpus));
  if (activity.overrun != Overrun::kSkip) add(map, "overrun", overrun_tree(activity));
  if (!activity.thread.empty()) add(map, "thread", activity.thread);
  if (activity.budget > base::Duration::zero()) add(map, "budget", to_text(activity.budget));
  if (map.entries.size() == 1 && activity.kind != Activity::Kind::kPeriodic) {
    return make_text(std::string(name_of(activity.kind)));
  }
  return map;
}

Value peer_tree(const Peer& peer) {
  if (peer.name == peer.component) return make_text(peer.component);
  Value map = make_map();
  add(map, peer.name, peer.component);
  return map;
}

Value property_file_tree(const PropertyFile& file) {
  if (!file.complete) return make_text(file.path);
  Value map = make_map();
  add(map, "file", file.path);
  add(map, "complete", "true");
  return map;
}

template <typename List, typename Convert>
std::vector<Value> converted(const List& list, Convert convert) {
  std::vector<Value> values;
  for (const auto& one : list) values.push_back(convert(one));
  return values;
}

Value reference_tree(const Reference& reference) { return make_text(reference.name); }

std::vector<Peer> peers_of(const Component& component, bool superior) {
  std::vector<Peer> peers;
  for (const Peer& peer : component.peers) {
    if (peer.superior == superior) peers.push_back(peer);
  }
  return peers;
}

Value call_tree(const Call& call) {
  if (call.with.empty()) return make_text(to_text(call.to));
  Value map = make_map();
  add(map, "call", to_text(call.to));
  add(map, "with", map_of(call.with));
  return map;
}

Value component_tree(const Component& component) {
  Value map = make_map();
  if (!component.model.empty()) add(map, "model", component.model);
  if (!component.remote.name.empty()) add(map, "remote", component.remote.name);
  if (!component.interface.name.empty()) add(map, "interface", component.interface.name);
  add(map, "activity", activity_tree(component.activity));
  add_items(map, "peers", converted(peers_of(component, false), peer_tree));
  add_items(map, "superiors", converted(peers_of(component, true), peer_tree));
  if (!component.bindings.empty()) {
    Value bind = make_map();
    for (const Binding& one : component.bindings)
      add(bind, one.name, one.component + "." + one.member);
    add(map, "bind", std::move(bind));
  }
  add_items(map, "calls", converted(component.calls, call_tree));
  add_items(map, "delays", converted(component.delays, reference_tree));
  add_items(map, "property_file", converted(component.property_files, property_file_tree));
  if (!component.properties.empty()) add(map, "properties", map_of(component.properties));
  if (!component.autoconf) add(map, "autoconf", "false");
  if (!component.autostart) add(map, "autostart", "false");
  if (component.autosave) add(map, "autosave", "true");
  if (component.shadow) add(map, "shadow", "true");
  return map;
}

Value to_tree(const NamedConnection& connection) {
  Value map = make_map();
  add(map, "name", connection.name);
  add_items(map, "ports", converted(connection.ports, [](const Endpoint& port) {
              return make_text(to_text(port));
            }));
  add_policy(connection.policy, map);
  return map;
}

Value composite_tree(const Composite& composite) {
  constexpr std::array<std::pair<const char*, ExportKind>, 4> kKinds = {
      {{"ports", ExportKind::kPort},
       {"operations", ExportKind::kOperation},
       {"events", ExportKind::kEvent},
       {"properties", ExportKind::kProperty}}};
  Value map = make_map();
  add(map, "model", composite.model);
  if (!composite.parameters.empty()) add(map, "parameters", map_of(composite.parameters));
  Value exports = make_map();
  for (const auto& [key, kind] : kKinds) {
    Value names = make_map();
    for (const Export& one : composite.exports) {
      if (one.kind == kind) add(names, one.name, one.component + "." + one.member);
    }
    if (!names.entries.empty()) add(exports, key, std::move(names));
  }
  if (!exports.entries.empty()) add(map, "exports", std::move(exports));
  return map;
}

Value operation_tree(const OperationOf& one) {
  return make_text(one.component + "." + one.operation);
}

Value grants_tree(const Document& document) {
  Value map = make_map();
  add_items(map, "script", converted(document.script_grants, operation_tree));
  add_items(map, "remote", converted(document.remote_grants, operation_tree));
  if (document.grants_on_hardware) add(map, "on_hardware", "true");
  return map;
}

Value mode_tree(const Mode& mode) {
  Value list = make_list();
  for (const Reference& component : mode.components) {
    list.items.push_back(make_text(component.name));
  }
  return list;
}

Value black_box_tree(const BlackBox& box) {
  if (!box.kept) return make_text("off");
  Value map = make_map();
  if (box.history) add(map, "history", to_text(*box.history));
  if (box.memory_kb) add(map, "memory_kB", std::to_string(*box.memory_kb));
  return map;
}

template <typename List, typename Convert>
void add_section(Value& tree, const char* key, const List& list, Convert convert) {
  if (list.empty()) return;
  Value map = make_map();
  for (const auto& one : list) add(map, one.name, convert(one));
  add(tree, key, std::move(map));
}

}  // namespace

void add_policy(const ConnectionPolicy& policy, Value& map) {
  if (policy.kind == ConnectionPolicy::Kind::kFifo) {
    Value fifo = make_map();
    add(fifo, "fifo", std::to_string(policy.capacity));
    if (policy.when_full != rt::WhenFull::kDropNewest) {
      add(fifo, "overflow", name_of(policy.when_full));
    }
    add(map, "policy", std::move(fifo));
  }
  if (policy.max_age) add(map, "max_age", to_text(*policy.max_age));
  if (policy.on_old) add(map, "on_old", name_of(*policy.on_old));
  if (policy.on_lost) add(map, "on_lost", name_of(*policy.on_lost));
  if (policy.one_cycle_delay) add(map, "delay", "one_cycle");
  if (policy.fan_in) add(map, "fan_in", "true");
}

Value to_tree(const Connection& connection) {
  Value map = make_map();
  add_policy(connection.policy, map);
  const bool commands = !connection.name.empty() || !connection.with.empty();
  if (map.entries.empty() && !commands) {
    return make_text(to_text(connection.from) + " -> " + to_text(connection.to));
  }
  Value whole = make_map();
  add(whole, commands ? "on" : "from", to_text(connection.from));
  add(whole, commands ? "do" : "to", to_text(connection.to));
  if (!connection.name.empty()) add(whole, "name", connection.name);
  if (!connection.with.empty()) add(whole, "with", map_of(connection.with));
  for (Property& entry : map.entries) whole.entries.push_back(std::move(entry));
  return whole;
}

/// `0660`.
static std::string octal(unsigned mode) {
  std::string digits{"0000"};
  for (auto at = digits.rbegin(); mode != 0 && at != digits.rend(); ++at, mode /= 8) {
    *at = static_cast<char>('0' + mode % 8);
  }
  return digits;
}

static Value network_tree(const Network& network) {
  Value map = make_map();
  add_items(map, "listen", converted(network.listen, reference_tree));
  const auto add_path = [](Value& to, const char* key, const Reference& path) {
    if (!path.name.empty()) add(to, key, path.name);
  };
  add_path(map, "policy", network.policy);
  add_path(map, "pages", network.pages);
  add_items(map, "inputs", converted(network.inputs, [](const Connection& input) {
              Value policy = make_map();
              add_policy(input.policy, policy);
              if (policy.entries.empty()) return make_text(to_text(input.to));
              Value whole = make_map();
              add(whole, "to", to_text(input.to));
              for (Property& entry : policy.entries) whole.entries.push_back(std::move(entry));
              return whole;
            }));
  Value tls = make_map();
  add_path(tls, "certificate", network.certificate);
  add_path(tls, "key", network.key);
  add_path(tls, "authority", network.authority);
  if (!tls.entries.empty()) add(map, "tls", std::move(tls));
  if (network.memory_kb) add(map, "memory_kB", std::to_string(*network.memory_kb));
  if (network.socket_mode) add(map, "socket_mode", octal(*network.socket_mode));
  if (network.serving) {
    Value serving = make_map();
    add(serving, "most", std::to_string(network.serving->most));
    add(serving, "least", std::to_string(network.serving->least));
    add(map, "serving", std::move(serving));
  }
  return map;
}

Value to_tree(const Document& document) {
  Value tree = make_map();
  if (!document.application.empty()) add(tree, "application", document.application);
  if (document.on_fault != OnFault::kStopDependents) {
    add(tree, "on_fault", name_of(document.on_fault));
  }
  if (!document.black_box.usual()) add(tree, "black_box", black_box_tree(document.black_box));
  if (document.priorities != Priorities::kLinux) {
    add(tree, "priorities", name_of(document.priorities));
  }
  add_items(tree, "accept", converted(document.accepted, reference_tree));
  add_items(tree, "operator_inputs",
            converted(document.operator_inputs,
                      [](const Connection& input) { return make_text(to_text(input.to)); }));
  if (document.most_threads) add(tree, "threads", std::to_string(*document.most_threads));
  add_items(tree, "libraries", converted(document.libraries, reference_tree));
  if (!document.parameters.empty()) add(tree, "parameters", map_of(document.parameters));
  add_section(tree, "components", document.components, component_tree);
  std::vector<Value> connections =
      converted(document.connections, [](const Connection& one) { return to_tree(one); });
  for (const NamedConnection& one : document.named_connections) connections.push_back(to_tree(one));
  add_items(tree, "connections", std::move(connections));
  add_section(tree, "composed", document.composites, composite_tree);
  if (Value grants = grants_tree(document); !grants.entries.empty()) {
    add(tree, "grants", std::move(grants));
  }
  add_items(tree, "before_stop", converted(document.before_stop, operation_tree));
  if (document.hold_at_stop) add(tree, "hold_at_stop", to_text(*document.hold_at_stop));
  if (Value network = network_tree(document.network); !network.entries.empty()) {
    add(tree, "network", std::move(network));
  }
  add_section(tree, "modes", document.modes, mode_tree);
  if (!document.mode.name.empty()) add(tree, "mode", document.mode.name);
  return tree;
}

}  // namespace armature::document
