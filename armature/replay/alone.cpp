// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/alone.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "armature/base/joined.hpp"
#include "armature/base/name_pattern.hpp"
#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/inlets.hpp"
#include "armature/exec/modes.hpp"
#include "armature/replay/comparison.hpp"
#include "armature/replay/order_in_cycle.hpp"
#include "armature/replay/outside.hpp"

namespace armature::replay {

using exec::Index;

namespace {

std::string path_of(const component::PortBase& port) {
  return port.owner().name() + '.' + port.name();
}

}  // namespace

/// The work of `Alone::of`.
class Isolation {
 public:
  Isolation(Alone& alone, bool real_time, deploy::Deployment& deployment,
            base::Diagnostics& diagnostics)
      : alone_(alone),
        real_time_(real_time),
        deployment_(deployment),
        blueprint_(deployment.blueprint),
        plan_(deployment.plan),
        diagnostics_(diagnostics) {}

  void run(const std::vector<std::string>& names, const std::string& folder) {
    choose(names);
    if (diagnostics_.ok()) check_calls();
    if (diagnostics_.ok()) read(folder);
    if (diagnostics_.ok()) find_inputs();
    if (!diagnostics_.ok()) return;
    tell_what_is_missing();
    if (real_time_) follow_cycles();
    const auto back = ways_back(plan_, [&](Index i) { return !runs(i) && !stays(at_entry(i)); });
    std::erase_if(blueprint_.connections, [&](const auto& one) { return back.contains(&one); });
    replace_others();
    if (diagnostics_.ok()) leave_out_what_needs_others();
  }

 private:
  const component::Component& at(Index index) const {
    return *blueprint_.components[index].component;
  }
  std::string name_of(Index index) const { return at(index).name(); }
  bool runs(Index index) const { return alone_.names_.contains(name_of(index)); }

  /// What is of the runtime, or writes down what happens, is there as it was.
  static bool stays(const exec::ComponentEntry& entry) {
    return is_reporter(entry) || entry.component->name() == exec::kModesName ||
           dynamic_cast<const exec::Inlets*>(entry.component.get()) != nullptr;
  }

  void choose(const std::vector<std::string>& names) {
    std::vector<std::string> known;
    for (const exec::ComponentEntry& entry : blueprint_.components) {
      if (stays(entry)) {
        alone_.there_.insert(entry.component->name());
      } else {
        known.push_back(entry.component->name());
      }
    }
    for (const std::string& name : names) {
      bool found = alone_.there_.contains(name);
      for (const std::string& one : known) {
        if (!base::matches(name, one)) continue;
        alone_.names_.insert(one);
        found = true;
      }
      if (found) continue;
      const base::Hint hint = base::suggestion(name, known);
      diagnostics_.error(
          {}, "there is no component " + base::quoted(name) + " that could run again", hint.text);
    }
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      if (!runs(i)) continue;
      check_chosen(i);
      for (const auto* const output : component::interface_of(at(i)).outputs) {
        outputs_.insert(path_of(*output));
      }
    }
  }

  void check_chosen(Index index) {
    const exec::ComponentEntry& entry = blueprint_.components[index];
    if (dynamic_cast<const component::StandIn*>(entry.component.get()) != nullptr) {
      diagnostics_.error(entry.where, base::quoted(name_of(index)) +
                                          " lives in another process, and was not here");
    } else if (speaks_to_others(entry)) {
      diagnostics_.error(entry.where,
                         base::quoted(name_of(index)) +
                             " speaks to others outside of this process, which are not what they "
                             "were: it cannot run again");
    }
    if (const std::string bus = bus_of_another_process(*entry.component); !bus.empty()) {
      diagnostics_.error(entry.where, base::quoted(name_of(index)) + " is on the bus '" + bus +
                                          "' of another process: it does not run again");
    }
    for (const exec::HardwarePlan& one : plan_.hardware) {
      if (one.component != entry.component.get()) continue;
      diagnostics_.error(entry.where, base::quoted(name_of(index)) + " drives a real robot by " +
                                          one.bus + ": it does not run again");
    }
  }

  /// What an operation answered is in no recording.
  void check_calls() {
    for (const auto& [pair, operations] : calls_between(true)) {
      const auto& [caller, callee] = pair;
      diagnostics_.error(blueprint_.components[caller].where,
                         base::quoted(name_of(caller)) + " calls " + base::quoted(name_of(callee)) +
                             ", whose answers are not recorded: " + base::joined(operations),
                         "let " + base::quoted(name_of(callee)) + " run again, too, or leave out " +
                             base::quoted(name_of(caller)));
    }
  }

  /// Names of operations by who calls whom, where one of the two runs.
  /// @param caller_runs  else who is called does
  std::map<std::pair<Index, Index>, std::vector<std::string>> calls_between(
      bool caller_runs) const {
    std::map<std::pair<Index, Index>, std::vector<std::string>> calls;
    for (const exec::CallPlan& call : plan_.calls) {
      const bool callee_runs = runs(call.callee) || stays(at_entry(call.callee));
      if (runs(call.caller) != caller_runs || callee_runs == caller_runs) continue;
      calls[{call.caller, call.callee}].emplace_back(call.operation->name());
    }
    return calls;
  }

  void read(const std::string& folder) {
    std::set<std::string> files;
    for (const exec::ComponentEntry& entry : blueprint_.components) {
      if (is_reporter(entry)) files.insert(file_of(entry));
    }
    alone_.channels_ = std::make_unique<RecordedChannels>(folder, files, diagnostics_);
    if (real_time_) alone_.begin_ = alone_.channels_->begin();
  }

  static component::PropertyBase* property_of(const exec::ComponentEntry& entry,
                                              std::string_view name) {
    for (component::PropertyBase* const property :
         component::interface_of(*entry.component).properties) {
      if (property->name() == name) return property;
    }
    return nullptr;
  }

  /// Of a recorder, without its folder: all are in that of the run.
  static std::string file_of(const exec::ComponentEntry& entry) {
    const component::PropertyBase* const file = property_of(entry, "file");
    if (file == nullptr) return {};
    return std::filesystem::path(types::to_text(file->type(), file->data())).filename().string();
  }

  /// Recorded under its own name, or under that of an input that it goes to.
  const ChannelSamples* find(const exec::ConnectionPlan& connection) const {
    const std::string input = path_of(*connection.input);
    const std::string output = path_of(*connection.output);
    for (const std::string& name : {output, input, input + " (" + output + ")"}) {
      if (const ChannelSamples* const found = alone_.channels_->find(name)) return found;
    }
    return nullptr;
  }

  void find_inputs() {
    for (const exec::ConnectionPlan& connection : plan_.connections) {
      if (!runs(connection.to) || runs(connection.from)) continue;
      given_.insert(path_of(*connection.input));
      if (stays(at_entry(connection.from)) || inputs_.contains(connection.output)) continue;
      const ChannelSamples* const channel = find(connection);
      const std::string output = path_of(*connection.output);
      const std::string way =
          base::quoted(output) + ", which goes to '" + path_of(*connection.input);
      if (channel == nullptr) {
        diagnostics_.error(connection.entry->where, way + "', is not recorded",
                           "have a Reporter record it (what: [" + output + "]), or let " +
                               base::quoted(name_of(connection.from)) + " run again, too");
      } else if (!channel->is_complete()) {
        diagnostics_.error(
            connection.entry->where, way + "', is recorded with gaps",
            "record it all the time, without 'every' and 'on_change', with a larger 'buffer'");
      } else {
        inputs_.emplace(connection.output, channel);
      }
    }
  }

  const exec::ComponentEntry& at_entry(Index index) const { return blueprint_.components[index]; }

  void tell_what_is_missing() {
    std::set<std::string> missing;
    for (const exec::SubscriptionPlan& told : plan_.subscriptions) {
      if (!runs(told.to) || runs(told.from)) continue;
      missing.insert("the event " + name_of(told.from) + '.' + std::string(told.event->name()));
    }
    for (const auto& [pair, operations] : calls_between(false)) {
      missing.insert("calls of " + name_of(pair.second) + " by " + name_of(pair.first) + " (" +
                     base::joined(operations) + ")");
    }
    if (missing.empty()) return;
    diagnostics_.warning({},
                         "what is not recorded does not come again: " +
                             base::joined({missing.begin(), missing.end()}),
                         "let those who raise or call run again, too, if it makes a difference");
  }

  /// Who runs in each cycle of a thread wrote in each of them what it wrote most often.
  void follow_cycles() {
    for (Index i = 0; i < plan_.threads.size(); ++i) {
      const exec::ThreadPlan& thread = plan_.threads[i];
      const bool runs_here = std::ranges::any_of(thread.updating, [&](Index k) { return runs(k); });
      if (thread.activity.kind != exec::Activity::Kind::kPeriodic || !runs_here) continue;
      if (const ChannelSamples* const most = most_recorded(thread.updating)) {
        cycles_[i] = most->times();
        continue;
      }
      diagnostics_.warning({},
                           "nothing is recorded without gaps that the thread " +
                               base::quoted(thread.name) +
                               " writes in each cycle: its cycles come once a period, from the "
                               "begin of the recordings on",
                           "have a Reporter record such an output");
    }
  }

  /// Of the outputs of those that run, one without gaps.
  const ChannelSamples* most_recorded(const std::vector<Index>& components) const {
    const ChannelSamples* most = nullptr;
    for (const Index i : components) {
      if (!runs(i)) continue;
      for (const auto* const output : component::interface_of(at(i)).outputs) {
        const ChannelSamples* const one = alone_.channels_->find(path_of(*output));
        if (one == nullptr || one->samples.empty() || !one->is_complete()) continue;
        if (most == nullptr || most->samples.size() < one->samples.size()) most = one;
      }
    }
    return most;
  }

  /// Threads keep what they have: who is recorded writes where its original ran.
  void replace_others() {
    exec::RecordedInstants& instants = deployment_.options.instants;
    instants.begin = alone_.begin_;
    std::map<Index, RecordedComponent*> replaced;
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      exec::ComponentEntry& entry = blueprint_.components[i];
      if (runs(i) || stays(entry)) continue;
      std::vector<RecordedOutput> outputs;
      for (const auto* const output : component::interface_of(*entry.component).outputs) {
        const auto input = inputs_.find(output);
        if (input == inputs_.end()) continue;
        outputs.push_back({output->name(), input->second, writes_behind_cycle(plan_, i, *output)});
      }
      auto recorded = std::make_unique<RecordedComponent>(std::move(entry.component));
      for (RecordedOutput& output : outputs) {
        const auto added = recorded->add(std::move(output));
        if (!added) diagnostics_.error(entry.where, added.error());
      }
      replaced[i] = recorded.get();
      entry.component = std::move(recorded);
      entry.peers.clear();
      entry.bindings.clear();
      entry.activity = {};
    }
    for (exec::ComponentEntry& entry : blueprint_.components) entry.shadow = false;
    for (const Index i : plan_.start_order) {
      if (replaced.contains(i)) alone_.recorded_.push_back(replaced[i]);
    }
    for (Index i = 0; i < plan_.threads.size(); ++i) seat(i, instants);
  }

  void seat(Index thread, exec::RecordedInstants& instants) {
    const exec::ThreadPlan& plan = plan_.threads[thread];
    if (plan.activity.kind != exec::Activity::Kind::kPeriodic) return;
    exec::Activity shared = plan.activity;
    shared.thread = plan.name;
    shared.budget = {};
    for (const Index member : plan.members) {
      exec::ComponentEntry& entry = blueprint_.components[member];
      const bool updates = std::ranges::find(plan.updating, member) != plan.updating.end();
      if (updates || !(runs(member) || stays(entry))) entry.activity = shared;
    }
    if (const auto times = cycles_.find(thread); times != cycles_.end()) {
      instants.cycles[plan.name] = times->second;
    }
  }

  void leave_out_what_needs_others() {
    std::erase_if(deployment_.options.before_stop,
                  [&](const auto& one) { return !alone_.names_.contains(one.component); });
    std::erase_if(blueprint_.components, [&](exec::ComponentEntry& entry) {
      return is_reporter(entry) && !record_those_alone(entry);
    });
    if (has_output_) return;
    diagnostics_.error({},
                       "nothing is recorded of what " +
                           base::joined({alone_.names_.begin(), alone_.names_.end()}) +
                           " wrote, so nothing can be compared",
                       "have a Reporter record it (what: [" + *alone_.names_.begin() + "])");
  }

  /// @return whether there is anything left to be recorded
  bool record_those_alone(exec::ComponentEntry& entry) {
    const std::vector<std::string> what = of_interest_in(file_of(entry));
    const auto set = [&](std::string_view name, const types::Value& value) {
      if (auto* const property = property_of(entry, name)) static_cast<void>(property->set(value));
    };
    set("what", types::Value::of(what));
    set("joints", types::Value::of(std::vector<std::string>()));
    set("csv", types::Value::of(std::string()));
    return !what.empty();
  }

  /// What components that run are given, and what they make of it, which is compared.
  std::vector<std::string> of_interest_in(const std::string& file) {
    std::vector<std::string> names;
    for (const std::string& channel : alone_.channels_->in_file(file)) {
      if (!alone_.names_.contains(std::string(component_of(channel)))) continue;
      const std::string name = channel.substr(0, channel.find(" ("));
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
      if (given_.contains(name)) continue;
      alone_.compared_.insert(channel);
      const ChannelSamples& recorded = *alone_.channels_->find(channel);
      if (!recorded.is_complete()) alone_.gaps_ = true;
      if (writes(name) && !recorded.samples.empty()) has_output_ = true;
    }
    return names;
  }

  /// Whether a component that runs writes what has this name: an output, or what goes to an input.
  bool writes(const std::string& name) const {
    return std::ranges::any_of(plan_.connections,
                               [&](const exec::ConnectionPlan& one) {
                                 return runs(one.from) && path_of(*one.input) == name;
                               }) ||
           std::ranges::any_of(outputs_, [&](const std::string& one) { return one == name; });
  }

  Alone& alone_;
  const bool real_time_;
  deploy::Deployment& deployment_;
  exec::Blueprint& blueprint_;
  const exec::Plan& plan_;
  base::Diagnostics& diagnostics_;
  std::map<const component::OutputPortBase*, const ChannelSamples*> inputs_;  ///< by their writers
  std::set<std::string> given_;                      ///< names of these inputs
  std::set<std::string> outputs_;                    ///< names, of components that run
  std::map<Index, std::vector<base::Time>> cycles_;  ///< by thread
  bool has_output_ = false;                          ///< something that they wrote is recorded
};

Alone Alone::of(const std::vector<std::string>& names, const std::string& folder, bool real_time,
                deploy::Deployment& deployment, base::Diagnostics& diagnostics) {
  Alone alone;
  Isolation(alone, real_time, deployment, diagnostics).run(names, folder);
  return alone;
}

std::vector<RecordedAct> Alone::acts_for(std::vector<RecordedAct> acts) const {
  std::set<std::uint32_t> begun;
  std::erase_if(acts, [&](const RecordedAct& recorded) {
    const exec::Act& act = recorded.act;
    if (act.kind == exec::Act::Kind::kCancel) return !begun.contains(act.command);
    if (act.component.empty()) return false;
    const std::string component(act.kind == exec::Act::Kind::kWrite ? component_of(act.item)
                                                                    : act.component);
    if (!names_.contains(component) && !there_.contains(component)) return true;
    if (act.kind == exec::Act::Kind::kBegin) begun.insert(act.command);
    return false;
  });
  return acts;
}

base::Time Alone::next() const {
  base::Time first = base::Time::max();
  for (const RecordedComponent* const each : recorded_) first = std::min(first, each->next());
  return first;
}

void Alone::play(exec::Application& application) const {
  for (RecordedComponent* const each : recorded_) {
    if (each->next() > application.now()) continue;
    static_cast<void>(application.run_in_thread_of(*each, [each] { each->play(); }));
  }
}

}  // namespace armature::replay
