// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <any>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <typeindex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/component/check.hpp"
#include "armature/component/checking/check_of_threads.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

using component::Component;
using component::InputPortBase;
using component::OutputPortBase;

/// What belongs to what, for a wiring of any size: without memory for each, in the plan's order.
template <typename From, typename To>
class Links {
 public:
  void add(const From* from, const To* to) { links_.emplace_back(from, to); }
  /// Before anything is looked for.
  void close() { std::ranges::stable_sort(links_, std::less<>(), &Link::first); }

  std::vector<const To*> all_of(const From& from) const {
    std::vector<const To*> all;
    for (const Link& link : std::ranges::equal_range(links_, &from, std::less<>(), &Link::first)) {
      all.push_back(link.second);
    }
    return all;
  }
  /// None if there is none.
  const To* one_of(const From& from) const {
    const auto at = std::ranges::lower_bound(links_, &from, std::less<>(), &Link::first);
    return at == links_.end() || at->first != &from ? nullptr : at->second;
  }

 private:
  using Link = std::pair<const From*, const To*>;
  std::vector<Link> links_;
};

/// The wiring as components see it when they are checked; found once, for all of them.
class PlannedWiring {
 public:
  PlannedWiring(const Blueprint& blueprint, const Plan& plan)
      : components(components_of(blueprint)) {
    for (const ConnectionPlan& connection : plan.connections) {
      writers.add(connection.input, connection.output);
      readers.add(connection.output, connection.input);
      if (connection.delayed) delayed.add(connection.output, connection.input);
    }
    for (const CallPlan& call : plan.calls) targets.add(call.requirement, call.operation);
    for (const SubscriptionPlan& told : plan.subscriptions) sources.add(told.handler, told.event);
    for (const Component* component : components) by_name[component->name()] = component;
    for (std::size_t i = 0; i < components.size(); ++i) threads[components[i]] = plan.thread_of[i];
    writers.close();
    readers.close();
    delayed.close();
    targets.close();
    sources.close();
  }

  const std::vector<Component*> components;
  std::unordered_map<std::string_view, const Component*> by_name;
  std::unordered_map<const Component*, std::size_t> threads;  ///< number of each one's
  Links<InputPortBase, OutputPortBase> writers;
  Links<OutputPortBase, InputPortBase> readers;
  Links<component::OperationCallerBase, component::OperationBase> targets;
  Links<OutputPortBase, InputPortBase> delayed;  ///< of the readers
  Links<component::EventHandlerBase, component::EventBase> sources;
};

/// What components worked out for each other.
using Answers = std::map<std::pair<const void*, std::type_index>, std::any>;

/// One component's view of it.
class PlannedCheck final : public component::Check, public component::CheckOfThreads {
 public:
  PlannedCheck(const ComponentEntry& entry, const PlannedWiring& wiring, Answers& answers,
               Plan& plan, base::Diagnostics& diagnostics)
      : entry_(entry), wiring_(wiring), answers_(answers), plan_(plan), diagnostics_(diagnostics) {}

  void error(std::string message, std::string hint) override {
    diagnostics_.error(entry_.where, named(message), std::move(hint));
  }
  void warning(std::string message, std::string hint) override {
    diagnostics_.warning(entry_.where, named(message), std::move(hint));
  }
  void drives_hardware(std::string bus) override {
    plan_.hardware.push_back({entry_.component.get(), std::move(bus)});
  }
  const std::vector<Component*>& components() const override { return wiring_.components; }
  std::vector<const Component*> peers() const override {
    std::vector<const Component*> peers;
    for (const PeerEntry& peer : entry_.peers) {
      const auto found = wiring_.by_name.find(peer.name);
      if (found != wiring_.by_name.end()) peers.push_back(found->second);
    }
    return peers;
  }
  std::vector<const OutputPortBase*> writers_of(const InputPortBase& input) const override {
    return wiring_.writers.all_of(input);
  }
  std::vector<const InputPortBase*> readers_of(const OutputPortBase& output) const override {
    return wiring_.readers.all_of(output);
  }
  bool delayed(const OutputPortBase& writer, const InputPortBase& reader) const override {
    const auto all = wiring_.delayed.all_of(writer);
    return std::ranges::find(all, &reader) != all.end();
  }
  const component::OperationBase* target_of(
      const component::OperationCallerBase& caller) const override {
    return wiring_.targets.one_of(caller);
  }
  const component::EventBase* source_of(const component::EventHandlerBase& handler) const override {
    return wiring_.sources.one_of(handler);
  }
  bool is_real_time() const override {
    const std::size_t thread = wiring_.threads.at(entry_.component.get());
    return plan_.threads[thread].activity.scheduler != Activity::Scheduler::kOther;
  }
  bool shares_thread_with(const Component& other) const override {
    return wiring_.threads.at(&other) == wiring_.threads.at(entry_.component.get());
  }

 private:
  std::any& answer(const void* about, std::type_index type) const override {
    return answers_[{about, type}];
  }
  std::string named(const std::string& message) const {
    return quoted(entry_.component->name()) + ": " + message;
  }

  const ComponentEntry& entry_;
  const PlannedWiring& wiring_;
  Answers& answers_;
  Plan& plan_;
  base::Diagnostics& diagnostics_;
};

void check_component(const Component& component, component::Check& check) {
  try {
    for (const component::Checked* part : component::interface_of(component).checked)
      part->check(check);
    component.on_check(check);
  } catch (const std::exception& thrown) {
    check.error(std::string("its check failed: ") + thrown.what());
  }
}

}  // namespace

void check_components(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  const PlannedWiring wiring(blueprint, plan);
  Answers answers;
  for (const ComponentEntry& entry : blueprint.components) {
    PlannedCheck check(entry, wiring, answers, plan, diagnostics);
    check_component(*entry.component, check);
  }
}

}  // namespace armature::exec::internal
