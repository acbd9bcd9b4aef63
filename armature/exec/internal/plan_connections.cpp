// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/internal/wiring.hpp"
#include "armature/exec/mismatch.hpp"

namespace armature::exec::internal {
namespace {

using component::InputPortBase;
using component::OutputPortBase;

std::string path(const component::PortBase& port) {
  return port.owner().name() + "." + port.name();
}

class ConnectionPlanner {
 public:
  ConnectionPlanner(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                    base::Diagnostics& diagnostics)
      : blueprint_(blueprint),
        directory_(directory),
        plan_(plan),
        diagnostics_(diagnostics),
        writers_(directory.input_count()) {}

  void run() {
    plan_.connections.reserve(blueprint_.connections.size());
    for (const ConnectionEntry& entry : blueprint_.connections) plan_one(entry);
    check_turns();
    for (Index i = 0; i < blueprint_.components.size(); ++i) check_open_inputs(i);
  }

 private:
  void plan_one(const ConnectionEntry& entry) {
    const Index from = find_component(entry.from_component, entry);
    const Index to = find_component(entry.to_component, entry);
    OutputPortBase* output = from == kNone ? nullptr : directory_.output(from, entry.from_port);
    const auto [input, number] =
        to == kNone ? Directory::Input() : directory_.input(to, entry.to_port);
    if (output == nullptr || input == nullptr) {
      if (from != kNone && to != kNone && is_backwards(from, to, entry)) return;
      if (from != kNone && output == nullptr) report_no_output(from, entry);
      if (to != kNone && input == nullptr) report_no_input(to, entry);
      return;
    }
    check_policy(entry);
    const bool fits = check_fit(*output, *input, entry);
    if (check_writers({output, from}, *input, number, entry) && fits) {
      plan_.connections.push_back({from, to, output, input, &entry, input->triggers(),
                                   entry.policy.one_cycle_delay, entry.max_age || entry.on_lost});
    }
  }

  Index find_component(const std::string& name, const ConnectionEntry& entry) {
    const Index found = directory_.component(name);
    if (found == kNone && blueprint_.absent.count(name) == 0) {
      diagnostics_.error(entry.where, "unknown component " + quoted(name),
                         base::suggestion(name, directory_.component_names()));
    }
    return found;
  }

  bool is_backwards(Index from, Index to, const ConnectionEntry& entry) {
    const InputPortBase* input = directory_.input(from, entry.from_port).port;
    const OutputPortBase* output = directory_.output(to, entry.to_port);
    if (input == nullptr || output == nullptr) return false;
    diagnostics_.error(entry.where,
                       "a connection goes from an output to an input, but " + quoted(path(*input)) +
                           " is an input and " + quoted(path(*output)) + " an output",
                       "exchange its ends: " + path(*output) + " -> " + path(*input));
    backwards_.insert(input);
    return true;
  }

  void report_no_output(Index component, const ConnectionEntry& entry) {
    const bool is_input = directory_.input(component, entry.from_port).port != nullptr;
    diagnostics_.error(
        entry.where,
        is_input ? quoted(entry.from_component + "." + entry.from_port) +
                       " is an input port, and a connection starts at an output port"
                 : quoted(entry.from_component) + " has no output port " + quoted(entry.from_port),
        base::suggestion(entry.from_port, directory_.output_names(component)));
  }

  void report_no_input(Index component, const ConnectionEntry& entry) {
    const bool is_output = directory_.output(component, entry.to_port) != nullptr;
    diagnostics_.error(
        entry.where,
        is_output ? quoted(entry.to_component + "." + entry.to_port) +
                        " is an output port, and a connection ends at an input port"
                  : quoted(entry.to_component) + " has no input port " + quoted(entry.to_port),
        base::suggestion(entry.to_port, directory_.input_names(component)));
  }

  void check_policy(const ConnectionEntry& entry) {
    const bool fifo = entry.policy.kind == component::ConnectionPolicy::Kind::kFifo;
    if (fifo && entry.policy.capacity == 0) {
      diagnostics_.error(entry.where, "a FIFO of size 0 holds no value",
                         "give it a size of at least 1");
    }
    if (fifo && entry.policy.one_cycle_delay) {
      diagnostics_.error(entry.where, "a connection is either a FIFO or delayed by one cycle",
                         "use the policy latest with the delay");
    }
    if (entry.max_age && entry.max_age->age <= base::Duration::zero()) {
      diagnostics_.error(entry.where, "the maximum age of a connection must be above 0");
    }
  }

  bool check_fit(const OutputPortBase& output, const InputPortBase& input,
                 const ConnectionEntry& entry) {
    const std::optional<Mismatch> found = mismatch(output, input);
    if (found) diagnostics_.error(entry.where, found->message, found->hint);
    return !found;
  }

  struct Writer {
    const OutputPortBase* port = nullptr;
    Index component = kNone;
  };

  bool check_writers(const Writer& writer, InputPortBase& input, Index number,
                     const ConnectionEntry& entry) {
    Writer& first = writers_[number];
    if (first.port == nullptr) {
      first = writer;
      return true;
    }
    if (first.port == writer.port || !more_writers_.emplace(&input, writer.port).second) {
      diagnostics_.error(
          entry.where,
          quoted(path(*writer.port)) + " is connected to " + quoted(path(input)) + " already",
          "remove one of the two connections");
      return false;
    }
    if (input.allows_fan_in() && plan_.modes.empty()) return true;
    std::vector<Writer>& all = several_[number];
    if (all.empty()) all.push_back(first);
    all.push_back(writer);
    return input.allows_fan_in() || take_turns(all, input, entry);
  }

  /// The last of `all` is new.
  bool take_turns(const std::vector<Writer>& all, InputPortBase& input,
                  const ConnectionEntry& entry) {
    const Writer& writer = all.back();
    for (auto other = all.begin(); other + 1 != all.end(); ++other) {
      if (!plan_.run_together(other->component, writer.component)) continue;
      const ModeSet both = plan_.modes_of[other->component] & plan_.modes_of[writer.component];
      diagnostics_.error(
          entry.where,
          quoted(path(input)) + " has two writers" + in_modes(plan_, both) + ": " +
              quoted(path(*other->port)) + " and " + quoted(path(*writer.port)),
          std::string("an input takes several writers only if its component declares fan_in") +
              (plan_.modes.empty() ? "" : ", or if no mode has more than one of them"));
      return false;
    }
    if (all.size() == 2) plan_.in_turns.push_back(&input);
    return true;
  }

  /// What waits in a FIFO of a writer that is not running any more would come after newer values.
  void check_turns() {
    for (const ConnectionPlan& each : plan_.connections) {
      const bool fifo = each.entry->policy.kind == component::ConnectionPolicy::Kind::kFifo;
      const auto& turns = plan_.in_turns;
      if (!fifo || std::find(turns.begin(), turns.end(), each.input) == turns.end()) continue;
      diagnostics_.error(each.entry->where,
                         "the writers of " + quoted(path(*each.input)) +
                             " take turns, and one of them has a FIFO, in which old values wait",
                         "use the policy latest");
    }
  }

  void check_open_inputs(Index component) {
    const ComponentEntry& entry = blueprint_.components[component];
    Index number = directory_.first_input(component);
    for (const InputPortBase* input : component::interface_of(*entry.component).inputs) {
      const Index here = number++;
      if (input->stays_open()) continue;
      const bool never = writers_[here].port == nullptr;
      const ModeSet unwritten = never ? 0 : plan_.modes_of[component] & ~written_in(here);
      if (never ? attempted(*input) : (unwritten & all_modes(plan_)) == 0) continue;
      diagnostics_.error(entry.where,
                         "input " + quoted(path(*input)) + " has no writer" +
                             (never ? std::string() : in_modes(plan_, unwritten)),
                         "connect an output to it");
    }
  }

  ModeSet written_in(Index number) {
    ModeSet modes = plan_.modes_of[writers_[number].component];
    if (const auto all = several_.find(number); all != several_.end()) {
      for (const Writer& writer : all->second) modes |= plan_.modes_of[writer.component];
    }
    return modes;
  }

  /// A connection to it exists but is wrong, which was reported.
  bool attempted(const InputPortBase& input) {
    if (backwards_.count(&input) > 0) return true;
    if (attempted_.empty()) {
      for (const ConnectionEntry& entry : blueprint_.connections) {
        attempted_.emplace(entry.to_component + "." + entry.to_port, true);
      }
    }
    return attempted_.count(path(input)) > 0;
  }

  const Blueprint& blueprint_;
  const Directory& directory_;
  Plan& plan_;
  base::Diagnostics& diagnostics_;
  std::vector<Writer> writers_;  ///< the first of each input, by its number
  std::set<std::pair<const InputPortBase*, const OutputPortBase*>> more_writers_;
  std::unordered_map<Index, std::vector<Writer>> several_;  ///< all of those that have more
  std::unordered_map<std::string, bool> attempted_;
  std::unordered_set<const InputPortBase*> backwards_;  ///< that a connection begins at
};

}  // namespace

void plan_connections(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                      base::Diagnostics& diagnostics) {
  ConnectionPlanner(blueprint, directory, plan, diagnostics).run();
}

}  // namespace armature::exec::internal
