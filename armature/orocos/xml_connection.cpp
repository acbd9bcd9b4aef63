// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/orocos/internal/xml_component.hpp"

namespace armature::orocos {

using namespace document;
namespace {

constexpr const char* kDefaultPolicy = "Default";

/// Joins ConnPolicy structs with the ports that name them.
class ConnectionReader {
 public:
  ConnectionReader(const std::vector<const XmlElement*>& policies,
                   const std::vector<XmlPort>& ports, const Limits& limits,
                   base::Diagnostics& diagnostics)
      : policies_(policies), limits_(limits), diagnostics_(diagnostics) {
    for (const XmlPort& port : ports) {
      if (ports_[port.connection].empty()) order_.push_back(port.connection);
      ports_[port.connection].push_back(&port);
    }
  }

  Value read() {
    Value list = make_list();
    Value standard = make_map();
    for (const XmlElement* policy : policies_) {
      if (policy->name == kDefaultPolicy) standard = policy_of(*policy);
    }
    for (const XmlElement* policy : policies_) {
      if (policy->name != kDefaultPolicy) read_policy(*policy, list);
    }
    for (const std::string& name : order_) {
      if (ports_.count(name) > 0) list.items.push_back(named(name, ports_[name], standard));
    }
    return list;
  }

 private:
  void read_policy(const XmlElement& policy, Value& list) {
    const auto ports = ports_.find(policy.name);
    if (ports == ports_.end()) {
      diagnostics_.named_warning("unused_connection", policy.where,
                                 "connection " + in_quotes(policy.name) + " has no ports",
                                 base::suggestion(policy.name, names_of_connections()));
      return;
    }
    const std::string* from = extra(policy, "from");
    const std::string* to = extra(policy, "to");
    if (from != nullptr && to != nullptr) {
      add_directed(policy, *from, *to, ports->second, list);
    } else {
      list.items.push_back(named(policy.name, ports->second, policy_of(policy)));
    }
    ports_.erase(ports);
  }

  std::vector<std::string> names_of_connections() const {
    std::vector<std::string> names;
    for (const auto& [name, ports] : ports_) names.push_back(name);
    return names;
  }

  static const std::string* extra(const XmlElement& element, std::string_view key) {
    for (const auto& [name, value] : element.extras) {
      if (name == key) return &value;
    }
    return nullptr;
  }

  /// `armature:from` and `armature:to` say what writes and what reads, in order.
  void add_directed(const XmlElement& policy, const std::string& from, const std::string& targets,
                    const std::vector<const XmlPort*>& ports, Value& list) {
    std::set<std::string> listed;
    for (const XmlPort* port : ports) listed.insert(text_of(*port));
    std::set<std::string> said = {from};
    const Value settings = policy_of(policy);
    std::istringstream stream(targets);
    for (std::string to; stream >> to;) {
      said.insert(to);
      Value map = make_map(policy.where);
      add_entry(map, "from", from, policy.where);
      add_entry(map, "to", to, policy.where);
      for (const Property& entry : settings.entries) map.entries.push_back(entry);
      list.items.push_back(std::move(map));
    }
    if (said == listed) return;
    diagnostics_.error(policy.where,
                       "connection " + in_quotes(policy.name) +
                           ": armature:from and armature:to name other ports than the structs "
                           "Ports of the components",
                       "change both, or remove armature:from and armature:to");
  }

  static std::string text_of(const XmlPort& port) { return port.component + "." + port.port; }

  static Value named(const std::string& name, const std::vector<const XmlPort*>& ports,
                     const Value& settings) {
    const base::Location& where = ports.front()->where;
    Value map = make_map(where);
    add_entry(map, "name", name, where);
    Value list = make_list(where);
    for (const XmlPort* port : ports) list.items.push_back(make_text(text_of(*port), port->where));
    add_entry(map, "ports", std::move(list));
    for (const Property& entry : settings.entries) map.entries.push_back(entry);
    return map;
  }

  Value policy_of(const XmlElement& element) {
    Value map = make_map(element.where);
    std::string type = "0";
    std::string size;
    for (const XmlElement& field : element.children) {
      if (field.name == "type") type = value_of(field, diagnostics_).text;
    }
    for (const XmlElement& field : element.children) {
      if (field.name == "type") continue;
      const std::string text = value_of(field, diagnostics_).text;
      if (field.name == "size") {
        size = text;
      } else {
        check_unused(element, field, text, type);
      }
    }
    add_fifo(element, type, size, map);
    XmlElement others = element;
    std::erase_if(others.extras,
                  [](const auto& extra) { return extra.first == "from" || extra.first == "to"; });
    add_extras(others, map, limits_, diagnostics_);
    return map;
  }

  void add_fifo(const XmlElement& element, const std::string& type, const std::string& size,
                Value& map) {
    if (type == "0" || type == "DATA") return;
    const bool buffer = type == "1" || type == "BUFFER";
    if (!buffer && type != "2" && type != "CIRCULAR_BUFFER") {
      diagnostics_.error(element.where, "connection " + in_quotes(element.name) +
                                            ": type must be 0 (DATA), 1 (BUFFER) or 2 "
                                            "(CIRCULAR_BUFFER), found " +
                                            in_quotes(type));
      return;
    }
    Value fifo = make_map(element.where);
    add_entry(fifo, "fifo", size, element.where);
    if (!buffer) add_entry(fifo, "overflow", "drop_oldest", element.where);
    add_entry(map, "policy", std::move(fifo));
  }

  void check_unused(const XmlElement& policy, const XmlElement& field, const std::string& text,
                    const std::string& type) {
    const std::string owner = "connection " + in_quotes(policy.name) + ": ";
    if (field.name == "transport" && text != "0") {
      diagnostics_.error(field.where, owner + "transport " + text + " is not supported",
                         "write 0: connections stay inside the process");
    } else if (field.name == "buffer_policy" && text != "0" && text != "1" &&
               (type == "0" || type == "DATA")) {
      diagnostics_.note(field.where,
                        owner + "buffer_policy is left out: the connection has no buffer");
    } else if (field.name == "buffer_policy" && text != "0" && text != "1") {
      diagnostics_.error(field.where, owner + "buffer_policy " + text + " is not supported",
                         "write 1: each connection has its own buffer");
    } else if (field.name == "lock_policy" || field.name == "init" || field.name == "pull" ||
               field.name == "data_size" || field.name == "max_threads" ||
               field.name == "mandatory") {
      diagnostics_.note(field.where, owner + field.name + " is left out: it has no effect here");
    } else if (field.name == "name_id" && !text.empty()) {
      diagnostics_.note(field.where, owner + "name_id is left out: it has no effect here");
    } else if (field.name != "transport" && field.name != "buffer_policy" &&
               field.name != "name_id") {
      diagnostics_.error(field.where, owner + "unknown field " + in_quotes(field.name),
                         base::suggestion(field.name, {"type", "size", "transport"}));
    }
  }

  const std::vector<const XmlElement*>& policies_;
  const Limits& limits_;
  base::Diagnostics& diagnostics_;
  std::map<std::string, std::vector<const XmlPort*>> ports_;
  std::vector<std::string> order_;
};

}  // namespace

Value connections_of(const std::vector<const XmlElement*>& policies,
                     const std::vector<XmlPort>& ports, const Limits& limits,
                     base::Diagnostics& diagnostics) {
  return ConnectionReader(policies, ports, limits, diagnostics).read();
}

}  // namespace armature::orocos
