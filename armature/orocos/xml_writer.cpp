// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "armature/document/source_text.hpp"
#include "armature/document/tree.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/orocos/deployer_file.hpp"
#include "armature/orocos/internal/xml_tree.hpp"

namespace armature::orocos {

using namespace document;
namespace {

constexpr int kCpusInMask = 32;

std::string text_of(const Endpoint& endpoint) { return endpoint.component + "." + endpoint.port; }

/// `0.01`: exact.
std::string seconds_text(base::Duration duration) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  std::string fraction =
      std::to_string(kNanosecondsPerSecond + duration.count() % kNanosecondsPerSecond);
  fraction[0] = '.';
  while (fraction.back() == '0') fraction.pop_back();
  if (fraction == ".") fraction = ".0";
  return std::to_string(duration.count() / kNanosecondsPerSecond) + fraction;
}

/// Connections that one ConnPolicy describes: from one output, with the same policy.
struct Group {
  std::string name;
  const Connection* first;
  std::vector<std::string> to;
  std::string policy;
};

class DeployerWriter {
 public:
  DeployerWriter(const Document& document, base::Diagnostics& diagnostics)
      : document_(document), diagnostics_(diagnostics), tree_(to_tree(document)) {}

  std::string write() {
    check_endpoints();
    group_connections();
    writer_.open("properties", root_attributes());
    for (const Reference& library : document_.libraries) {
      writer_.simple({{"name", "Import"}, {"type", "string"}}, library.name);
    }
    for (const Group& group : groups_) write_group(group);
    for (const NamedConnection& named : document_.named_connections) {
      write_policy(named.name, named.policy, {});
    }
    const Property* components = find(tree_.entries, "components");
    for (std::size_t i = 0; i < document_.components.size(); ++i) {
      write_component(document_.components[i], components->value.entries[i].value);
    }
    writer_.close();
    report_extensions();
    std::string text = writer_.take();
    const bool possible = std::none_of(text.begin(), text.end(), is_forbidden_control);
    if (!possible) {
      diagnostics_.error({document_.file, 0, 0},
                         "a text has control characters, which XML cannot contain");
    }
    return text;
  }

 private:
  using Attributes = XmlWriter::Attributes;

  /// An attribute `armature:key` with the YAML that `map` has for the key; counted for the report.
  void extend(Attributes& attributes, const Value& map, const std::string& key) {
    const Property* entry = find(map.entries, key);
    if (entry == nullptr) return;
    attributes.emplace_back("armature:" + key, flow_text(entry->value));
    ++extensions_[key];
  }

  Attributes root_attributes() {
    Attributes attributes = {{"xmlns:armature", "urn:armature:deployment"}};
    for (const char* key : {"application", "on_fault", "black_box", "parameters", "composed",
                            "grants", "before_stop", "hold_at_stop", "network", "modes", "mode",
                            "threads", "priorities", "accept", "operator_inputs"}) {
      extend(attributes, tree_, key);
    }
    return attributes;
  }

  void report_extensions() {
    for (const auto& [key, count] : extensions_) {
      diagnostics_.note({document_.file, 0, 0}, "OROCOS ignores armature:" + key + " (" +
                                                    std::to_string(count) +
                                                    (count == 1 ? " place)" : " places)"));
    }
  }

  /// A connection stands where its components are; without them it has no place.
  void check_endpoints() {
    std::set<std::string> known;
    for (const Component& component : document_.components) known.insert(component.name);
    const auto check = [&](const Endpoint& endpoint) {
      if (known.count(endpoint.component) > 0) return;
      diagnostics_.error(endpoint.where, "port " + in_quotes(text_of(endpoint)) +
                                             " cannot be written: unknown component " +
                                             in_quotes(endpoint.component));
    };
    for (const Connection& one : document_.connections) {
      check(one.from);
      check(one.to);
      if (one.name.empty() && one.with.empty()) continue;
      diagnostics_.error(one.where,
                         "the event " + in_quotes(text_of(one.from)) +
                             " gives a command, which OROCOS files do not have",
                         "write it as YAML");
    }
    for (const NamedConnection& one : document_.named_connections) {
      for (const Endpoint& port : one.ports) check(port);
    }
  }

  /// Neighbouring connections from one output with one policy become one OROCOS connection, unless
  /// an input among them has other writers too.
  void group_connections() {
    std::map<std::string, int> writers;
    std::set<std::string> taken;
    for (const Connection& one : document_.connections) ++writers[text_of(one.to)];
    for (const NamedConnection& one : document_.named_connections) taken.insert(one.name);
    for (const Connection& one : document_.connections) {
      Value policy = make_map();
      add_policy(one.policy, policy);
      const std::string settings = flow_text(policy);
      const bool joins = !groups_.empty() && writers[text_of(one.to)] == 1 &&
                         groups_.back().policy == settings &&
                         text_of(groups_.back().first->from) == text_of(one.from) &&
                         writers[groups_.back().to.front()] == 1;
      if (!joins) groups_.push_back({free_name(taken), &one, {}, settings});
      groups_.back().to.push_back(text_of(one.to));
      connections_of_[text_of(one.to)].push_back(groups_.back().name);
      if (!joins) connections_of_[text_of(one.from)].push_back(groups_.back().name);
    }
    for (const NamedConnection& one : document_.named_connections) {
      for (const Endpoint& port : one.ports) connections_of_[text_of(port)].push_back(one.name);
    }
  }

  static std::string free_name(std::set<std::string>& taken) {
    std::size_t number = taken.size() + 1;
    std::string name = "connection" + std::to_string(number);
    while (!taken.insert(name).second) name = "connection" + std::to_string(++number);
    return name;
  }

  void write_group(const Group& group) {
    std::string targets;
    for (const std::string& to : group.to) targets += (targets.empty() ? "" : " ") + to;
    write_policy(group.name, group.first->policy,
                 {{"armature:from", text_of(group.first->from)}, {"armature:to", targets}});
  }

  void write_policy(const std::string& name, const ConnectionPolicy& policy, Attributes more) {
    Value map = make_map();
    add_policy(policy, map);
    Attributes attributes = {{"name", name}, {"type", "ConnPolicy"}};
    std::move(more.begin(), more.end(), std::back_inserter(attributes));
    for (const char* key : {"max_age", "on_old", "on_lost", "delay", "fan_in"}) {
      extend(attributes, map, key);
    }
    const bool circular = policy.when_full == rt::WhenFull::kDropOldest;
    const bool fifo = policy.kind == ConnectionPolicy::Kind::kFifo;
    writer_.open("struct", attributes);
    writer_.simple({{"name", "type"}, {"type", "short"}}, !fifo ? "0" : circular ? "2" : "1");
    writer_.simple({{"name", "size"}, {"type", "short"}},
                   std::to_string(fifo ? policy.capacity : 0));
    writer_.close();
  }

  void write_component(const Component& component, const Value& tree) {
    Attributes attributes = {{"name", component.name}, {"type", component.model}};
    for (const char* key :
         {"remote", "interface", "bind", "calls", "superiors", "delays", "shadow"}) {
      extend(attributes, tree, key);
    }
    writer_.open("struct", attributes);
    write_activity(component.activity, find(tree.entries, "activity")->value);
    write_flag("AutoConf", component.autoconf);
    write_flag("AutoStart", component.autostart);
    if (component.autosave) write_flag("AutoSave", true);
    write_peers(component);
    write_ports(component);
    if (const Property* properties = find(tree.entries, "properties")) {
      writer_.property({"Properties", properties->value, {}, {}});
    }
    for (const PropertyFile& file : component.property_files) {
      writer_.simple(
          {{"name", file.complete ? "PropertyFile" : "UpdateProperties"}, {"type", "string"}},
          file.path);
    }
    writer_.close();
  }

  void write_flag(const char* name, bool flag) {
    writer_.simple({{"name", name}, {"type", "boolean"}}, flag ? "1" : "0");
  }

  void write_activity(const Activity& activity, const Value& tree) {
    const char* type = activity.kind == Activity::Kind::kPeriodic    ? "PeriodicActivity"
                       : activity.kind == Activity::Kind::kTriggered ? "NonPeriodicActivity"
                                                                     : "SequentialActivity";
    const bool mask = std::all_of(activity.cpus.begin(), activity.cpus.end(),
                                  [](int cpu) { return cpu < kCpusInMask; });
    Attributes attributes = {{"name", "Activity"}, {"type", type}};
    for (const char* key : {"overrun", "thread", "budget"}) extend(attributes, tree, key);
    if (!mask) extend(attributes, tree, "cpus");
    if (activity.scheduler == Activity::Scheduler::kDeadline) extend(attributes, tree, "scheduler");
    writer_.open("struct", attributes);
    if (activity.kind == Activity::Kind::kPeriodic) {
      writer_.simple({{"name", "Period"}, {"type", "double"}}, seconds_text(activity.period));
    }
    if (activity.kind != Activity::Kind::kSequential) write_thread(activity, mask);
    writer_.close();
  }

  void write_thread(const Activity& activity, bool mask) {
    // In real time OROCOS reads 0 as 1; what check refuses is not made possible by writing it.
    const bool missing =
        activity.scheduler == Activity::Scheduler::kRealtime && activity.priority == 0;
    if (!missing) {
      writer_.simple({{"name", "Priority"}, {"type", "short"}}, std::to_string(activity.priority));
    }
    if (activity.scheduler_given) {
      const bool other = activity.scheduler == Activity::Scheduler::kOther;
      writer_.simple({{"name", "Scheduler"}, {"type", "string"}},
                     other ? "ORO_SCHED_OTHER" : "ORO_SCHED_RT");
    }
    if (activity.cpus.empty() || !mask) return;
    std::uint32_t bits = 0;
    for (const int cpu : activity.cpus) bits |= 1u << cpu;
    writer_.simple({{"name", "CpuAffinity"}, {"type", "ulong"}}, std::to_string(bits));
  }

  void write_peers(const Component& component) {
    if (component.peers.empty()) return;
    writer_.open("struct", {{"name", "Peers"}, {"type", "PropertyBag"}});
    for (const Peer& peer : component.peers) {
      Attributes attributes = {{"type", "string"}};
      if (peer.name != peer.component) {
        attributes.emplace_back("armature:component", peer.component);
        ++extensions_["component"];
      }
      writer_.simple(attributes, peer.name);
    }
    writer_.close();
  }

  void write_ports(const Component& component) {
    const std::string prefix = component.name + ".";
    auto port = connections_of_.lower_bound(prefix);
    const auto is_mine = [&] {
      return port != connections_of_.end() && port->first.rfind(prefix, 0) == 0;
    };
    if (!is_mine()) return;
    writer_.open("struct", {{"name", "Ports"}, {"type", "PropertyBag"}});
    for (; is_mine(); ++port) {
      const std::string name = port->first.substr(prefix.size());
      if (name.find('.') != std::string::npos) continue;  // of a part of this name
      for (const std::string& connection : port->second) {
        writer_.simple({{"name", name}, {"type", "string"}}, connection);
      }
    }
    writer_.close();
  }

  const Document& document_;
  base::Diagnostics& diagnostics_;
  Value tree_;
  XmlWriter writer_;
  std::vector<Group> groups_;
  std::map<std::string, std::vector<std::string>> connections_of_;
  std::map<std::string, int> extensions_;
};

}  // namespace

std::string write_xml(const Document& document, base::Diagnostics& diagnostics) {
  return DeployerWriter(document, diagnostics).write();
}

}  // namespace armature::orocos
