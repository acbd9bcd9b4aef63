// SPDX-License-Identifier: Apache-2.0
#include "armature/orocos/internal/xml_component.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"

namespace armature::orocos {

using namespace document;
namespace {

/// Reads one component's struct.
class ComponentReader {
 public:
  ComponentReader(const XmlElement& element, std::vector<XmlPort>& ports, const Limits& limits,
                  base::Diagnostics& diagnostics)
      : element_(element), ports_(ports), limits_(limits), diagnostics_(diagnostics) {
    body_ = make_map(element.where);
  }

  Value read() {
    if (!element_.type.empty()) add_entry(body_, "model", element_.type, element_.where);
    refuse_twins();
    for (const XmlElement& child : element_.children) read_child(child);
    add_flags();
    if (!files_.items.empty()) add_entry(body_, "property_file", std::move(files_));
    add_extras(element_, body_, limits_, diagnostics_);
    return std::move(body_);
  }

 private:
  /// Of what a component has once, OROCOS takes the first and leaves out the others silently.
  void refuse_twins() {
    std::unordered_map<std::string_view, const base::Location*> first;
    for (const XmlElement& child : element_.children) {
      const auto once = {"Activity", "Peers",     "Ports",   "Properties",
                         "AutoConf", "AutoStart", "AutoSave"};
      if (std::find(once.begin(), once.end(), child.name) == once.end()) continue;
      const auto [earlier, is_new] = first.emplace(child.name, &child.where);
      if (is_new) continue;
      error(child.where, in_quotes(child.name) + " is given twice",
            "first at " + place_text(*earlier->second));
    }
  }

  void read_child(const XmlElement& child) {
    if (is_script(child)) return refuse_script(child);
    if (child.is_simple()) return read_simple(child);
    if (child.name == "Activity") {
      add_entry(body_, "activity", activity(child));
    } else if (child.name == "Peers") {
      add_entry(body_, "peers", peers(child));
    } else if (child.name == "Ports") {
      read_ports(child);
    } else if (child.name == "Properties") {
      Value properties = make_map(child.where);
      properties.entries = properties_of(child, diagnostics_);
      add_entry(body_, "properties", std::move(properties));
    } else {
      refuse(child);
    }
  }

  void read_simple(const XmlElement& child) {
    const std::string& name = child.name;
    if (name == "PropertyFile" || name == "PropFile" || name == "UpdateProperties" ||
        name == "LoadProperties") {
      read_property_file(child);
    } else if (name == "AutoConf") {
      autoconf_ = &child;
    } else if (name == "AutoStart") {
      autostart_ = &child;
    } else if (name == "AutoSave") {
      add_entry(body_, "autosave", value_of(child, diagnostics_));
    } else if (name == "Service" || name == "Plugin" || name == "Provides") {
      warn("service_left_out", child,
           "service " + in_quotes(child.text) + " is left out: Armature has no services");
    } else if (name == "Server" || name == "UseNamingService") {
      warn("service_left_out", child, name + " is left out: Armature does not use CORBA");
    } else if (name == "AutoConnect" && value_of(child, diagnostics_).text == "false") {
      return;
    } else {
      refuse(child);
    }
  }

  static bool is_script(const XmlElement& child) {
    return child.name == "RunScript" || child.name == "ProgramScript" ||
           child.name == "StateMachineScript";
  }

  /// One script, or a struct of several. To leave one out could leave out what watches over a
  /// robot.
  void refuse_script(const XmlElement& child) {
    for (const XmlElement& each : child.children) refuse_script(each);
    if (!child.is_simple()) return;
    error(child.where, "OROCOS script " + in_quotes(child.text) + " cannot run here",
          "remove it, rewrite it in Lua and start that with armature run --script");
  }

  void refuse(const XmlElement& child) {
    if (child.name == "AutoConnect") {
      error(child.where, "AutoConnect is not supported", "list the ports under Ports");
    } else {
      error(
          child.where,
          "unknown " + std::string(child.is_simple() ? "simple " : "struct ") +
              in_quotes(child.name),
          base::suggestion(child.name, {"Activity", "Peers", "Ports", "Properties", "PropertyFile",
                                        "UpdateProperties", "AutoConf", "AutoStart", "AutoSave"}));
    }
  }

  void error(const base::Location& where, const std::string& message, base::Hint hint = {}) {
    diagnostics_.error(where, "component " + in_quotes(element_.name) + ": " + message,
                       std::move(hint));
  }
  void warn(const char* name, const XmlElement& child, const std::string& message) {
    diagnostics_.named_warning(name, child.where,
                               "component " + in_quotes(element_.name) + ": " + message);
  }

  void read_property_file(const XmlElement& child) {
    files_.kind = Value::Kind::kList;
    Value file = make_map(child.where);
    add_entry(file, "file", child.text, child.where);
    const bool complete = child.name == "PropertyFile" || child.name == "PropFile";
    if (complete) add_entry(file, "complete", "true", child.where);
    if (child.name == "LoadProperties") {
      diagnostics_.note(child.where, "component " + in_quotes(element_.name) +
                                         ": LoadProperties is read as UpdateProperties: no "
                                         "property is created");
    }
    files_.items.push_back(std::move(file));
  }

  /// OROCOS neither configures nor starts by itself; started components are configured before.
  void add_flags() {
    const Value no = make_text("false", element_.where);
    Value start = autostart_ == nullptr ? no : value_of(*autostart_, diagnostics_);
    Value configure = autoconf_ != nullptr ? value_of(*autoconf_, diagnostics_) : start;
    add_entry(body_, "autoconf", std::move(configure));
    add_entry(body_, "autostart", std::move(start));
  }

  Value peers(const XmlElement& list) {
    Value peers = make_list(list.where);
    for (const XmlElement& child : list.children) {
      const auto full = std::find_if(child.extras.begin(), child.extras.end(),
                                     [](const auto& extra) { return extra.first == "component"; });
      if (full == child.extras.end()) {
        peers.items.push_back(make_text(child.text, child.where));
        continue;
      }
      Value named = make_map(child.where);
      add_entry(named, child.text, full->second, child.where);
      peers.items.push_back(std::move(named));
    }
    return peers;
  }

  void read_ports(const XmlElement& list) {
    for (const XmlElement& child : list.children) {
      if (!child.is_simple() || child.name.empty() || child.text.empty()) {
        error(child.where,
              "an entry of Ports needs the name of a port, and the name of a connection as its "
              "value");
        continue;
      }
      ports_.push_back({child.text, element_.name, child.name, child.where});
    }
  }

  Value activity(const XmlElement& element) {
    Value map = make_map(element.where);
    const std::string& type = element.type;
    const bool sequential = type == "SequentialActivity";
    const XmlElement* period = child_of(element, "Period");
    const bool has_period = period != nullptr && !is_zero(period->text);
    if (type == "PeriodicActivity" || (type == "Activity" && has_period)) {
      if (period == nullptr) {
        error(element.where, "a PeriodicActivity needs its Period");
      } else {
        add_entry(map, "periodic", value_of(*period, diagnostics_).text + " s", period->where);
      }
    } else if (sequential) {
      add_entry(map, "sequential", "true", element.where);
    } else {
      add_entry(map, "triggered", "true", element.where);
      if (type != "NonPeriodicActivity" && type != "Activity") refuse_activity(element);
    }
    for (const XmlElement& setting : element.children) {
      if (sequential) {
        warn("setting_left_out", setting,
             setting.name + " is left out: a sequential activity has none");
      } else {
        read_setting(setting, map);
      }
    }
    add_extras(element, map, limits_, diagnostics_);
    if (!sequential) settle_priority(element, map);
    return map;
  }

  /// As OROCOS does it on Linux: real time has a priority of at least 1, other threads have none.
  void settle_priority(const XmlElement& element, Value& map) {
    const Property* const scheduler = find(map.entries, "scheduler");
    const Property* const priority = find(map.entries, "priority");
    if (scheduler == nullptr) return;
    const bool zero = child_of(element, "Priority") != nullptr && priority == nullptr;
    if (scheduler->value.text == "realtime" && zero) {
      warn("priority_changed", element, "Priority 0 of ORO_SCHED_RT is read as Priority 1");
      add_entry(map, "priority", "1", element.where);
    } else if (scheduler->value.text == "other" && priority != nullptr) {
      warn("priority_changed", element,
           "Priority " + priority->value.text +
               " is left out: threads of ORO_SCHED_OTHER have none");
      std::erase_if(map.entries, [](const Property& one) { return one.name == "priority"; });
    }
  }

  void refuse_activity(const XmlElement& element) {
    error(element.where, "unknown activity " + in_quotes(element.type),
          base::suggestion(element.type, {"PeriodicActivity", "NonPeriodicActivity",
                                          "SequentialActivity", "SlaveActivity", "Activity"}));
  }

  void read_setting(const XmlElement& setting, Value& map) {
    if (setting.name == "Period") return;
    if (setting.name == "Priority") {
      if (!is_zero(setting.text)) add_entry(map, "priority", value_of(setting, diagnostics_));
    } else if (setting.name == "Scheduler") {
      read_scheduler(setting, map);
    } else if (setting.name == "CpuAffinity") {
      if (Value list = cpus(setting); !list.items.empty()) add_entry(map, "cpus", std::move(list));
    } else {
      error(setting.where, "unknown setting " + in_quotes(setting.name) + " of an activity",
            base::suggestion(setting.name, {"Period", "Priority", "Scheduler", "CpuAffinity"}));
    }
  }

  void read_scheduler(const XmlElement& setting, Value& map) {
    if (setting.text == "ORO_SCHED_RT" || setting.text == "ORO_SCHED_OTHER") {
      const bool realtime = setting.text == "ORO_SCHED_RT";
      add_entry(map, "scheduler", realtime ? "realtime" : "other", setting.where);
      return;
    }
    error(setting.where,
          "Scheduler must be ORO_SCHED_RT or ORO_SCHED_OTHER, found " + in_quotes(setting.text));
  }

  /// The numbers of the bits that are set.
  Value cpus(const XmlElement& setting) {
    Value list = make_list(setting.where);
    const std::string text = value_of(setting, diagnostics_).text;
    std::uint64_t mask = 0;
    std::from_chars(text.data(), text.data() + text.size(), mask);
    if (mask == 0) error(setting.where, "CpuAffinity must have at least one bit set");
    for (int cpu = 0; cpu < 64; ++cpu) {
      const bool set = ((mask >> cpu) & 1u) != 0;
      if (set) list.items.push_back(make_text(std::to_string(cpu), setting.where));
    }
    return list;
  }

  static const XmlElement* child_of(const XmlElement& element, std::string_view name) {
    for (const XmlElement& child : element.children) {
      if (child.name == name) return &child;
    }
    return nullptr;
  }

  static bool is_zero(std::string_view number) {
    return number.find_first_not_of("0. \t\r\n") == std::string_view::npos;
  }

  const XmlElement& element_;
  std::vector<XmlPort>& ports_;
  const Limits& limits_;
  base::Diagnostics& diagnostics_;
  Value body_;
  Value files_;
  const XmlElement* autoconf_ = nullptr;
  const XmlElement* autostart_ = nullptr;
};

}  // namespace

void add_entry(Value& map, std::string key, Value value) {
  const base::Location where = value.where;
  map.entries.push_back({std::move(key), std::move(value), {}, where});
}

void add_entry(Value& map, std::string key, std::string text, const base::Location& where) {
  add_entry(map, std::move(key), make_text(std::move(text), where));
}

void add_extras(const XmlElement& element, Value& map, const Limits& limits,
                base::Diagnostics& diagnostics) {
  for (const auto& [key, text] : element.extras) {
    Value value = parse_yaml_value(text, element.where, limits, diagnostics);
    Property* same = find(map.entries, key);
    if (same == nullptr) {
      add_entry(map, key, std::move(value));
    } else {
      same->value = std::move(value);
    }
  }
}

Value component_of(const XmlElement& element, std::vector<XmlPort>& ports, const Limits& limits,
                   base::Diagnostics& diagnostics) {
  return ComponentReader(element, ports, limits, diagnostics).read();
}

}  // namespace armature::orocos
