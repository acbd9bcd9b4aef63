// SPDX-License-Identifier: Apache-2.0
// Shadows look on beside those who drive. What is of a shadow stays among shadows: data, calls,
// events, commands and time on a thread.
#include <algorithm>
#include <string>
#include <vector>

#include "armature/component/interface.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

class ShadowCheck {
 public:
  ShadowCheck(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics)
      : blueprint_(blueprint), plan_(plan), diagnostics_(diagnostics) {}

  void run() {
    check_data();
    check_calls();
    check_events();
    check_threads();
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      if (is_shadow(i)) check_itself(i);
    }
    for (const HardwarePlan& one : plan_.hardware) {
      const auto entry = std::ranges::find_if(blueprint_.components, [&](const auto& each) {
        return each.component.get() == one.component;
      });
      if (entry == blueprint_.components.end() || !entry->shadow) continue;
      diagnostics_.error(
          entry->where,
          quoted(one.component->name()) + " is a shadow, but drives a real robot by " + one.bus,
          "remove shadow, or the component");
    }
  }

 private:
  bool is_shadow(Index i) const { return blueprint_.components[i].shadow; }
  std::string name_of(Index i) const { return quoted(blueprint_.components[i].component->name()); }
  /// Only a shadow on the way to who is none is a matter of this check.
  bool leaves(Index from, Index to) const { return is_shadow(from) && !is_shadow(to); }
  std::string hint(Index to) const {
    return "a shadow moves nothing: only shadows may use it; is " + name_of(to) +
           " one, such as a comparison, say shadow: true of it";
  }

  void check_data() {
    for (const ConnectionPlan& connection : plan_.connections) {
      expect_no_answer(connection);
      if (!leaves(connection.from, connection.to)) continue;
      diagnostics_.error(connection.entry->where,
                         "the shadow " + name_of(connection.from) + " writes '" +
                             connection.entry->to_component + "." + connection.entry->to_port +
                             "', which is not of a shadow",
                         hint(connection.to));
    }
  }

  /// Who writes to a full queue is told, and may do something about it.
  void expect_no_answer(const ConnectionPlan& connection) {
    const bool queue = connection.entry->policy.kind == component::ConnectionPolicy::Kind::kFifo;
    if (!queue || !leaves(connection.to, connection.from)) return;
    diagnostics_.error(connection.entry->where,
                       "the shadow " + name_of(connection.to) + " takes data of " +
                           name_of(connection.from) +
                           " by a queue, whose writer is told when it is full",
                       "leave out the policy: a shadow takes the latest value");
  }

  void check_calls() {
    for (const CallPlan& call : plan_.calls) {
      if (is_shadow(call.caller) == is_shadow(call.callee)) continue;
      const bool by_shadow = is_shadow(call.caller);
      const Index other = by_shadow ? call.callee : call.caller;
      diagnostics_.error(
          blueprint_.components[call.caller].where,
          (by_shadow ? "the shadow " : "") + name_of(call.caller) + " calls '" +
              blueprint_.components[call.callee].component->name() + "." +
              std::string(call.operation->name()) + "'" +
              (by_shadow ? ", which is not of a shadow" : ", which is of a shadow"),
          by_shadow ? "give it a shadow of its own to call: another component of that model"
                    : hint(other));
    }
  }

  void check_events() {
    for (const SubscriptionPlan& told : plan_.subscriptions) {
      expect_own_thread(told);
      if (!leaves(told.from, told.to)) continue;
      diagnostics_.error(blueprint_.components[told.to].where,
                         name_of(told.to) + " is told of the event '" + told.event->owner().name() +
                             "." + std::string(told.event->name()) + "', which is of a shadow",
                         hint(told.to));
    }
  }

  /// A handler in the thread of who drives would take its time, whatever thread the shadow has.
  void expect_own_thread(const SubscriptionPlan& told) {
    if (!told.handler->runs_in_raisers_thread() || !leaves(told.to, told.from)) return;
    diagnostics_.error(blueprint_.components[told.to].where,
                       "the shadow " + name_of(told.to) + " handles the event '" +
                           told.event->owner().name() + "." + std::string(told.event->name()) +
                           "' in the thread of " + name_of(told.from) + ", and takes its time",
                       "a component of this model cannot be a shadow that is told of this event");
  }

  /// A shadow that computes for long holds up nobody.
  void check_threads() {
    for (const ThreadPlan& thread : plan_.threads) {
      const auto shadow =
          std::ranges::find_if(thread.members, [&](Index i) { return is_shadow(i); });
      if (shadow == thread.members.end()) continue;
      const auto other =
          std::ranges::find_if(thread.members, [&](Index i) { return !is_shadow(i); });
      const ComponentEntry& entry = blueprint_.components[*shadow];
      if (other != thread.members.end()) {
        diagnostics_.error(entry.where,
                           "the shadow " + name_of(*shadow) + " would run in the thread " +
                               quoted(thread.name) + " of " + name_of(*other) +
                               ", which is none, and take its time",
                           "give it a thread of its own, for example activity: {periodic: 10 ms, "
                           "scheduler: other}");
      } else if (const ThreadPlan* const held_up = less_urgent(thread)) {
        diagnostics_.error(entry.where,
                           "the shadow " + name_of(*shadow) + " is as urgent as the thread " +
                               quoted(held_up->name) + ", or more, and could hold it up",
                           "give it a lower priority, or scheduler: other");
      }
    }
  }

  /// A thread in real time, of no shadow, that has to wait while this one runs.
  const ThreadPlan* less_urgent(const ThreadPlan& shadow) const {
    if (shadow.activity.scheduler == Activity::Scheduler::kOther) return nullptr;
    for (const ThreadPlan& thread : plan_.threads) {
      const bool theirs =
          std::ranges::any_of(thread.members, [&](Index i) { return !is_shadow(i); });
      const bool in_real_time = thread.activity.scheduler != Activity::Scheduler::kOther;
      if (theirs && in_real_time && urgency(thread.activity) <= urgency(shadow.activity)) {
        return &thread;
      }
    }
    return nullptr;
  }

  void check_itself(Index i) {
    const ComponentEntry& entry = blueprint_.components[i];
    if (!component::interface_of(*entry.component).holdings.empty()) {
      diagnostics_.error(entry.where,
                         name_of(i) +
                             " is a shadow, but keeps something from moving, and would "
                             "hold up the end of a run",
                         "a component of this model cannot be a shadow");
    }
    if (dynamic_cast<const component::StandIn*>(entry.component.get()) != nullptr) {
      diagnostics_.error(entry.where,
                         name_of(i) +
                             " is a shadow, but stands for a component of another process, which "
                             "gets its data and calls and may drive",
                         "remove shadow, or remote");
    }
    if (!component::interface_of(*entry.component).observers.empty()) {
      diagnostics_.error(entry.where,
                         name_of(i) +
                             " is a shadow, but reaches other components without a connection, "
                             "which no check sees",
                         "remove shadow: a recorder needs none, and what writes to others cannot "
                         "be one");
    }
    for (const PeerEntry& peer : entry.peers) {
      if (!peer.superior) continue;
      diagnostics_.error(peer.where,
                         name_of(i) + " is a shadow, which nobody commands, but has the superior " +
                             quoted(peer.name),
                         "remove it from superiors");
    }
  }

  const Blueprint& blueprint_;
  const Plan& plan_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

void check_shadows(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics) {
  if (std::ranges::none_of(blueprint.components, &ComponentEntry::shadow)) return;
  ShadowCheck(blueprint, plan, diagnostics).run();
}

}  // namespace armature::exec::internal
