// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

#include "armature/document/reader.hpp"
#include "armature/document/typed_text.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::document {
namespace {

constexpr int kLowestPriority = 1;
constexpr int kHighestPriority = 99;
constexpr int kHighestRtaiPriority = 255;
constexpr int kHighestCpu = 1023;
constexpr int kMostCyclesLate = 1'000'000;

void read_overrun(const Value& value, const ValueReader& reader, Activity& activity) {
  if (value.kind != Value::Kind::kMap) {
    assign(reader.choice<Overrun>(value, "overrun"), activity.overrun);
    return;
  }
  Fields fields(value, reader);
  if (const Value* limit = fields.take("fault")) {
    activity.overrun = Overrun::kFault;
    assign(reader.whole_number(*limit, "overrun fault", 1, kMostCyclesLate),
           activity.late_cycles_to_fault);
  } else {
    reader.error(value.where, "overrun has no policy", "write skip, catch_up or {fault: 5}");
  }
  fields.refuse_others();
}

/// Stands for a period that could not be read, which was reported, so that the rest is checked.
constexpr base::Duration kUnreadPeriod = std::chrono::seconds(1);
/// No thread keeps a shorter one: waking up alone costs some microseconds.
constexpr base::Duration kShortestPeriod = std::chrono::microseconds(10);

void read_period(const Value& value, const ValueReader& reader, Activity& activity) {
  activity.period = kUnreadPeriod;
  const std::optional<base::Duration> period = reader.duration(value, "periodic");
  if (!period) return;
  if (*period < kShortestPeriod) {
    reader.error(value.where,
                 "periodic must be at least " + to_text(kShortestPeriod) + ", found " +
                     in_quotes(value.text),
                 "no thread keeps a shorter period");
    return;
  }
  activity.period = *period;
}

/// The kind of activity that the keys name; at most one of them may.
void read_kind(Fields& fields, const Value& value, const ValueReader& reader, Activity& activity) {
  const Value* periodic = fields.take("periodic");
  const Value* triggered = fields.take("triggered");
  const Value* sequential = fields.take("sequential");
  const int given = (periodic != nullptr) + (triggered != nullptr) + (sequential != nullptr);
  if (given > 1) {
    reader.error(value.where, "an activity is either periodic, triggered or sequential",
                 "keep one of these keys");
    return;
  }
  if (periodic != nullptr) {
    activity.kind = Activity::Kind::kPeriodic;
    read_period(*periodic, reader, activity);
  }
  const auto choose = [&](const Value* flag, Activity::Kind kind) {
    if (flag == nullptr) return;
    activity.kind = kind;
    activity.period = {};
    if (reader.flag(*flag, name_of(kind)) == false) {
      reader.error(flag->where, std::string(name_of(kind)) + " can only be true",
                   "leave it out, or choose another activity");
    }
  };
  choose(triggered, Activity::Kind::kTriggered);
  choose(sequential, Activity::Kind::kSequential);
}

void read_activity_name(const Value& value, const ValueReader& reader, Activity& activity) {
  const Choices<Activity::Kind> choices = {{"sequential", Activity::Kind::kSequential},
                                           {"triggered", Activity::Kind::kTriggered}};
  if (value.text == name_of(Activity::Kind::kPeriodic)) {
    reader.error(value.where, "a periodic activity needs its period",
                 "for example {periodic: 10 ms}");
    return;
  }
  assign(reader.choice(value, "activity", choices), activity.kind);
}

/// Refuses settings that this kind of activity cannot have.
void check_activity(const Value& value, const ValueReader& reader, const Activity& activity) {
  const auto given = [&](std::string_view key) { return find(value.entries, key) != nullptr; };
  const auto refuse = [&](std::string_view key, const char* reason) {
    if (given(key)) {
      reader.error(find(value.entries, key)->where, std::string(key) + " does not apply to a " +
                                                        std::string(name_of(activity.kind)) +
                                                        " activity, " + reason);
    }
  };
  if (activity.kind == Activity::Kind::kSequential) {
    for (const char* key : {"priority", "scheduler", "cpus"}) {
      refuse(key, "which runs in the thread of the component that triggers it");
    }
  }
  if (activity.kind != Activity::Kind::kPeriodic) {
    for (const char* key : {"overrun", "thread"}) refuse(key, "which has no period");
  }
}

/// A priority counts in real time only. One of before gives way to a scheduler that has none.
void check_priority(const Value& value, const ValueReader& reader, Activity& activity) {
  const bool has_none =
      activity.scheduler_given && activity.scheduler != Activity::Scheduler::kRealtime;
  if (!has_none || activity.priority == 0) return;
  if (const Property* priority = find(value.entries, "priority")) {
    reader.error(
        priority->where,
        "priority has no effect with the scheduler " + std::string(name_of(activity.scheduler)),
        "remove one of the two; a priority goes with scheduler: realtime");
  }
  activity.priority = 0;
}

void read_cpus(const Value& value, const ValueReader& reader, Activity& activity) {
  activity.cpus.clear();
  const std::vector<const Value*> cpus = items_of(&value);
  if (cpus.empty()) {
    reader.error(value.where, "cpus is an empty list, so no CPU could run it",
                 "name a CPU, or leave out cpus for any");
  }
  for (const Value* cpu : cpus) {
    if (const auto number = reader.whole_number(*cpu, "cpus", 0, kHighestCpu)) {
      activity.cpus.push_back(*number);
    }
  }
  std::sort(activity.cpus.begin(), activity.cpus.end());
  const auto end = std::unique(activity.cpus.begin(), activity.cpus.end());
  activity.cpus.erase(end, activity.cpus.end());
}

void read_peer(const Value& value, const ValueReader& reader, std::vector<Peer>& peers) {
  if (value.kind != Value::Kind::kMap) {
    if (auto name = reader.dotted_name(value, "peer")) peers.push_back({*name, *name, value.where});
    return;
  }
  for (const Property& entry : value.entries) {
    const Value& component = entry.value;
    if (!is_dotted_name(entry.name)) {
      reader.error(entry.where, "peer " + in_quotes(entry.name) + " is not a valid name");
    } else if (component.kind == Value::Kind::kText && is_dotted_name(component.text)) {
      peers.push_back({entry.name, component.text, component.where});
    } else {
      const bool text = component.kind == Value::Kind::kText;
      reader.error(component.where,
                   "peer " + in_quotes(entry.name) + " must be the name of a component, found " +
                       (text ? in_quotes(component.text) : std::string(name_of(component.kind))),
                   "peers are a list of components, peers: [" + entry.name +
                       "]; a map gives them other names");
    }
  }
}

/// A peer that is there twice would serve each requirement twice.
void check_peers(std::vector<Peer>& peers, const ValueReader& reader) {
  std::map<std::string, base::Location> first;
  std::erase_if(peers, [&](const Peer& peer) {
    const auto [earlier, is_new] = first.emplace(peer.name, peer.where);
    if (is_new) return false;
    reader.error(peer.where, "peer " + in_quotes(peer.name) + " is given twice",
                 "first at " + place_text(earlier->second));
    return true;
  });
}

void read_bindings(const Value& value, const ValueReader& reader, Component& component) {
  Fields fields(value, reader);
  for (const Property& entry : value.entries) {
    const auto target = reader.dotted_name(entry.value, "bind " + entry.name);
    if (!is_dotted_name(entry.name)) {
      reader.error(entry.where, "bind " + in_quotes(entry.name) + " is not a valid name");
    }
    if (!target) continue;
    auto [peer, member] = split_last_dot(*target);
    if (peer.empty()) peer = std::exchange(member, entry.name);
    component.bindings.push_back(
        {entry.name, std::move(peer), std::move(member), entry.value.where});
  }
}

/// `Component.operation`, or a map with its parameters.
void read_call(const Value& value, const ValueReader& reader, std::vector<Call>& calls) {
  constexpr const char* kHint = "for example {call: Vision.setThreshold, with: {low: 10}}";
  Call call;
  call.where = value.where;
  const Value* to = &value;
  if (value.kind == Value::Kind::kMap) {
    Fields fields(value, reader);
    to = fields.take("call");
    const Value* with = fields.take("with");
    fields.refuse_others();
    const bool map = with == nullptr || with->kind == Value::Kind::kMap;
    if (!map) reader.error(with->where, "with must be a map", kHint);
    if (map && with != nullptr) call.with = with->entries;
  }
  if (to == nullptr) return reader.error(value.where, "an entry of calls has no 'call'", kHint);
  const auto name = reader.dotted_name(*to, "calls");
  if (!name) return;
  auto [component, operation] = split_last_dot(*name);
  if (component.empty()) {
    return reader.error(to->where,
                        "calls has " + in_quotes(*name) + ", expected Component.operation", kHint);
  }
  call.to = {std::move(component), std::move(operation), to->where};
  calls.push_back(std::move(call));
}

void read_property_file(const Value& value, const ValueReader& reader, Component& component) {
  PropertyFile file{{}, false, value.where};
  if (value.kind == Value::Kind::kMap) {
    Fields fields(value, reader);
    const Value* path = fields.take("file");
    if (path != nullptr) assign(reader.text(*path, "file"), file.path);
    if (const Value* complete = fields.take("complete")) {
      assign(reader.flag(*complete, "complete"), file.complete);
    }
    fields.refuse_others();
    if (path == nullptr) reader.error(value.where, "property_file has no 'file'");
  } else {
    assign(reader.text(value, "property_file"), file.path);
  }
  if (!file.path.empty()) component.property_files.push_back(std::move(file));
}

void read_properties(const Value& value, const ValueReader& reader, Component& component) {
  if (value.kind != Value::Kind::kMap) {
    reader.error(value.where,
                 "properties must be a map, found " + std::string(name_of(value.kind)));
    return;
  }
  for (const Property& property : value.entries) {
    if (!is_dotted_name(property.name)) {
      reader.error(property.where, "property " + in_quotes(property.name) + " is not a valid name");
    }
    check_values("property " + in_quotes(property.name), property.value, reader);
  }
  component.properties = value.entries;
}

void read_flags(Fields& fields, const ValueReader& reader, Component& component) {
  const std::pair<const char*, bool*> flags[] = {{"autoconf", &component.autoconf},
                                                 {"autostart", &component.autostart},
                                                 {"autosave", &component.autosave},
                                                 {"shadow", &component.shadow}};
  for (const auto& [key, flag] : flags) {
    if (const Value* value = fields.take(key)) assign(reader.flag(*value, key), *flag);
  }
}

/// What a file describes lives in another process: nothing here can run it.
void check_interface(const Value& body, const ValueReader& reader, const Component& component) {
  const base::Location& where = component.interface.where;
  if (!component.model.empty()) {
    reader.error(where, "it has a model and an interface, which both say what it has",
                 "leave out one of them");
  }
  if (find(body.entries, "remote") == nullptr) {
    reader.error(where, "it has an interface, which describes a component of another process",
                 "say where it is: remote: tcp://host:port/Name");
  }
}

void check_component(const Value& body, const ValueReader& reader, const Component& component) {
  const Property* model = find(body.entries, "model");
  const bool reported = model != nullptr && model->value.kind == Value::Kind::kNone;
  const bool described = find(body.entries, "interface") != nullptr;
  if (component.model.empty() && !reported && !described) {
    reader.error(component.where, "it has no model", "write model: and a component model's name");
  }
  if (described) check_interface(body, reader, component);
  if (component.autostart && !component.autoconf) {
    reader.error(component.where, "autostart needs autoconf",
                 "set autoconf: true, or autostart: false");
  }
  if (component.autosave && component.property_files.empty()) {
    reader.error(component.where, "autosave needs a property_file",
                 "for example property_file: properties.cpf");
  }
}

}  // namespace

void check_values(const std::string& name, const Value& value, const ValueReader& reader) {
  if (value.kind == Value::Kind::kNone && !value.literal) {
    reader.error(value.where, name + " has no value",
                 "braces of {i} and ${name} need quotes; an empty text is \"\"");
  }
  if (const std::string wrong = wrong_with(value); !wrong.empty()) {
    reader.error(value.where, name + " of type " + value.type + " " + wrong);
  }
  for (const Value& item : value.items) check_values(name, item, reader);
  for (const Property& entry : value.entries) {
    if (entry.name.empty()) reader.error(entry.where, name + " has a key without a name");
    check_values(name, entry.value, reader);
  }
}

void read_activity(const Value& value, const ValueReader& reader, Priorities priorities,
                   Activity& activity) {
  activity.where = value.where;
  if (value.kind == Value::Kind::kText) {
    read_activity_name(value, reader, activity);
    return;
  }
  Fields fields(value, reader);
  read_kind(fields, value, reader, activity);
  if (const Value* priority = fields.take("priority")) {
    const int highest = priorities == Priorities::kRtai ? kHighestRtaiPriority : kHighestPriority;
    assign(reader.whole_number(*priority, "priority", kLowestPriority, highest), activity.priority);
  }
  if (const Value* scheduler = fields.take("scheduler")) {
    const auto chosen = reader.choice<Activity::Scheduler>(*scheduler, "scheduler");
    activity.scheduler_given = chosen.has_value();
    assign(chosen, activity.scheduler);
  }
  if (const Value* cpus = fields.take("cpus")) read_cpus(*cpus, reader, activity);
  if (const Value* overrun = fields.take("overrun")) read_overrun(*overrun, reader, activity);
  if (const Value* thread = fields.take("thread")) {
    assign(reader.name(*thread, "thread"), activity.thread);
  }
  if (const Value* budget = fields.take("budget")) {
    assign(reader.duration(*budget, "budget"), activity.budget);
  }
  fields.refuse_others();
  check_activity(value, reader, activity);
  check_priority(value, reader, activity);
}

Component read_component(const std::string& name, const base::Location& where, const Value& body,
                         Priorities priorities, base::Diagnostics& diagnostics) {
  Component component;
  component.name = name;
  component.where = where;
  component.model_where = where;
  component.activity.where = where;
  const ValueReader reader("component '" + name + "'", diagnostics);
  Fields fields(body, reader);
  if (const Value* model = fields.take("model")) {
    assign(reader.text(*model, "model"), component.model);
    component.model_where = model->where;
  }
  if (const Value* remote = fields.take("remote")) {
    assign(reader.text(*remote, "remote"), component.remote.name);
    component.remote.where = remote->where;
  }
  if (const Value* interface = fields.take("interface")) {
    assign(reader.text(*interface, "interface"), component.interface.name);
    component.interface.where = interface->where;
  }
  if (const Value* activity = fields.take("activity")) {
    read_activity(*activity, reader, priorities, component.activity);
  }
  if (const Value* properties = fields.take("properties")) {
    read_properties(*properties, reader, component);
  }
  for (const Value* superior : items_of(fields.take("superiors"))) {
    read_peer(*superior, reader, component.peers);
  }
  for (Peer& peer : component.peers) peer.superior = true;
  for (const Value* peer : items_of(fields.take("peers"))) {
    read_peer(*peer, reader, component.peers);
  }
  check_peers(component.peers, reader);
  if (const Value* bind = fields.take("bind")) read_bindings(*bind, reader, component);
  for (const Value* call : items_of(fields.take("calls"))) {
    read_call(*call, reader, component.calls);
  }
  for (const Value* delay : items_of(fields.take("delays"))) {
    if (auto other = reader.dotted_name(*delay, "delays")) {
      component.delays.push_back({*other, delay->where});
    }
  }
  for (const Value* file : items_of(fields.take("property_file"))) {
    read_property_file(*file, reader, component);
  }
  read_flags(fields, reader, component);
  fields.refuse_others();
  check_component(body, reader, component);
  return component;
}

}  // namespace armature::document
