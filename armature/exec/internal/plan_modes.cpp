// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/exec/internal/wiring.hpp"
#include "armature/exec/modes.hpp"

namespace armature::exec::internal {
namespace {

constexpr ModeSet kAll = ~ModeSet{0};

ModeSet bit(std::size_t mode) { return ModeSet{1} << mode; }

class ModePlanner {
 public:
  ModePlanner(const Blueprint& blueprint, const Directory& directory, Plan& plan,
              base::Diagnostics& diagnostics)
      : blueprint_(blueprint), directory_(directory), plan_(plan), diagnostics_(diagnostics) {}

  void run() {
    plan_.modes_of.assign(blueprint_.components.size(), kAll);
    if (blueprint_.modes.empty()) return refuse_initial();
    if (blueprint_.modes.size() > kMostModes) {
      diagnostics_.error(blueprint_.modes[kMostModes].where,
                         "the deployment has more than " + std::to_string(kMostModes) + " modes");
      return;
    }
    std::vector<ModeSet> named(blueprint_.components.size(), 0);
    for (std::size_t m = 0; m < blueprint_.modes.size(); ++m) plan_one(m, named);
    const ModeSet everywhere = all_modes(plan_);
    for (Index i = 0; i < named.size(); ++i) {
      const bool switched = named[i] != 0 && named[i] != everywhere;
      if (switched) plan_.modes_of[i] = named[i];
    }
    find_initial();
  }

 private:
  void refuse_initial() {
    const ModeMember& initial = blueprint_.initial_mode;
    if (initial.component.empty()) return;
    diagnostics_.error(
        initial.where,
        "unknown mode " + quoted(initial.component) + ": the deployment has no modes",
        "add modes: {NAME: [COMPONENT, COMPONENT]}");
  }

  void plan_one(std::size_t mode, std::vector<ModeSet>& named) {
    const ModeEntry& entry = blueprint_.modes[mode];
    check_name(mode);
    plan_.modes.push_back({entry.name, {}});
    if (entry.members.empty()) {
      diagnostics_.error(entry.where, "the mode " + quoted(entry.name) + " has no components",
                         "name those that run in it and not in other modes");
    }
    for (const ModeMember& member : entry.members) {
      const Index found = find_member(entry, member);
      if (found == kNone) continue;
      if ((named[found] & bit(mode)) != 0) {
        diagnostics_.error(member.where, quoted(member.component) + " is named twice in the mode " +
                                             quoted(entry.name));
      }
      named[found] |= bit(mode);
    }
  }

  void check_name(std::size_t mode) {
    const ModeEntry& entry = blueprint_.modes[mode];
    if (entry.name.empty() || ModeName(entry.name).view() != entry.name) {
      diagnostics_.error(entry.where,
                         "the name of a mode has 1 to 63 letters: " + quoted(entry.name));
    }
    for (std::size_t earlier = 0; earlier < mode; ++earlier) {
      if (blueprint_.modes[earlier].name != entry.name) continue;
      diagnostics_.error(entry.where, "two modes are named " + quoted(entry.name));
    }
  }

  Index find_member(const ModeEntry& mode, const ModeMember& member) {
    const std::string& name = member.component;
    const Index found = directory_.component(name);
    if (found == kNone) {
      if (blueprint_.absent.count(name) > 0) return kNone;
      diagnostics_.error(
          member.where,
          "the mode " + quoted(mode.name) + " has the unknown component " + quoted(name),
          base::suggestion(name, directory_.component_names()));
      return kNone;
    }
    const ComponentEntry& entry = blueprint_.components[found];
    if (name == kModesName) {
      diagnostics_.error(member.where, quoted(name) + " switches between modes: it runs in all");
      return kNone;
    }
    if (!entry.autostart || !entry.autoconfigure) {
      diagnostics_.error(member.where,
                         quoted(name) + " is in the mode " + quoted(mode.name) +
                             ", but does not start with the application",
                         "leave autostart and autoconf on: its modes say when it runs");
    }
    return found;
  }

  void find_initial() {
    const ModeMember& initial = blueprint_.initial_mode;
    if (initial.component.empty()) return;
    std::vector<std::string> names;
    for (std::size_t m = 0; m < plan_.modes.size(); ++m) {
      names.push_back(plan_.modes[m].name);
      if (names.back() != initial.component) continue;
      plan_.initial_mode = m;
      return;
    }
    diagnostics_.error(initial.where, "unknown mode " + quoted(initial.component),
                       base::suggestion(initial.component, names));
  }

  const Blueprint& blueprint_;
  const Directory& directory_;
  Plan& plan_;
  base::Diagnostics& diagnostics_;
};

/// Between two cycles of one thread nothing is missed; between those of several there would be.
void check_one_thread(const Blueprint& blueprint, const Plan& plan,
                      base::Diagnostics& diagnostics) {
  const auto name_of = [&](Index i) { return quoted(blueprint.components[i].component->name()); };
  const auto thread_of = [&](Index i) { return quoted(plan.threads[plan.thread_of[i]].name); };
  Index first = kNone;
  for (const Index member : plan.start_order) {
    if (plan.modes_of[member] == kAll) continue;
    if (first == kNone) first = member;
    if (plan.thread_of[member] == plan.thread_of[first]) continue;
    diagnostics.error(blueprint.components[member].where,
                      name_of(member) + " runs in the thread " + thread_of(member) + ", " +
                          name_of(first) + " in " + thread_of(first) +
                          ": components that modes switch must share one thread",
                      "give both the same activity, or have the same thread trigger both");
  }
}

/// Who calls or hears somebody that never runs when it does.
void check_partners(const Blueprint& blueprint, const Plan& plan, base::Diagnostics& diagnostics) {
  const auto check = [&](Index user, Index used, std::string_view what) {
    if (plan.run_together(user, used)) return;
    const ComponentEntry& entry = blueprint.components[user];
    diagnostics.error(entry.where, quoted(entry.component->name()) + " uses " + quoted(what) +
                                       " of " +
                                       quoted(blueprint.components[used].component->name()) +
                                       ", but no mode runs both");
  };
  for (const CallPlan& call : plan.calls) check(call.caller, call.callee, call.operation->name());
  for (const SubscriptionPlan& told : plan.subscriptions) {
    check(told.to, told.from, told.event->name());
  }
}

}  // namespace

ModeSet all_modes(const Plan& plan) {
  return plan.modes.size() >= kMostModes ? kAll : bit(plan.modes.size()) - 1;
}

std::string in_modes(const Plan& plan, ModeSet set) {
  set &= all_modes(plan);
  if (set == all_modes(plan)) return {};
  std::string names;
  int count = 0;
  for (std::size_t m = 0; m < plan.modes.size(); ++m) {
    if ((set & bit(m)) == 0) continue;
    names += (count++ == 0 ? "" : ", ") + quoted(plan.modes[m].name);
  }
  return (count == 1 ? " in the mode " : " in the modes ") + names;
}

void plan_modes(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                base::Diagnostics& diagnostics) {
  ModePlanner(blueprint, directory, plan, diagnostics).run();
}

void plan_members(const Blueprint& blueprint, Plan& plan, base::Diagnostics& diagnostics) {
  if (plan.modes.empty()) return;
  for (const Index component : plan.start_order) {
    if (plan.modes_of[component] == kAll) continue;
    for (std::size_t m = 0; m < plan.modes.size(); ++m) {
      if ((plan.modes_of[component] & bit(m)) != 0) plan.modes[m].members.push_back(component);
    }
  }
  check_one_thread(blueprint, plan, diagnostics);
  check_partners(blueprint, plan, diagnostics);
}

}  // namespace armature::exec::internal
